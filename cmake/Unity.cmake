# The target `unity` (ThrowTheSwitch's Unity, 2.4.3 or later): a checkout named by UNITY_ROOT, else
# an installed package, else what `make deps` unpacked.

set(UNITY_ROOT "" CACHE PATH "A checkout of Unity, with src/unity.c in it")

if(NOT UNITY_ROOT)
    find_package(unity CONFIG QUIET)
endif()

if(TARGET unity::framework)
    add_library(unity ALIAS unity::framework)
else()
    set(checkout ${UNITY_ROOT})
    if(NOT checkout)
        set(checkout ${PROJECT_SOURCE_DIR}/build/_deps/unity)
    endif()
    if(NOT EXISTS ${checkout}/src/unity.c)
        message(FATAL_ERROR
            "No Unity in ${checkout}. Type `make deps`, or name a checkout of it with -DUNITY_ROOT=, "
            "or build without the tests: -DBUILD_TESTING=OFF")
    endif()
    add_library(unity STATIC ${checkout}/src/unity.c)
    target_include_directories(unity SYSTEM PUBLIC ${checkout}/src)
    target_compile_options(unity PRIVATE -w)
endif()
