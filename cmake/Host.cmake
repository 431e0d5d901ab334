# The host's half of the tree: muster itself and the tests.

option(BUILD_TESTING "Build the tests (they need Unity: make deps)" ON)
option(MUSTER_FUZZ "Build the fuzz targets, and nothing else (needs clang)" OFF)
set(MUSTER_SANITIZE "" CACHE STRING "What -fsanitize= is given, such as address,undefined")

# Where the other presets leave what is run from here: images and fuzz targets.
set(MUSTER_FIRMWARE_DIR ${PROJECT_SOURCE_DIR}/build/firmware)
set(MUSTER_FUZZ_DIR ${PROJECT_SOURCE_DIR}/build/fuzz)

include(GNUInstallDirs)
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(CMINPACK REQUIRED IMPORTED_TARGET cminpack)
pkg_check_modules(FYAML REQUIRED IMPORTED_TARGET libfyaml)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(BLUEZ REQUIRED IMPORTED_TARGET bluez)
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET libsystemd)

# Assertions stay on. Native robots have to give the chip's bits on every machine: no contraction
# of a*b+c, and nothing that depends on the processor at hand.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g")
add_compile_options(-ffp-contract=off)
if(MUSTER_SANITIZE)
    add_compile_options(-fsanitize=${MUSTER_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${MUSTER_SANITIZE})
endif()

add_subdirectory(common)
# Build folders of their own, for build/firmware belongs to the firmware preset.
add_subdirectory(firmware/core robot/core)
add_subdirectory(server/core)
add_subdirectory(server/flash)
add_subdirectory(server/link)
add_subdirectory(server/loop)
add_subdirectory(server/mocap)
add_subdirectory(server/parameters)
add_subdirectory(server/scenario)
add_subdirectory(server/service)
add_subdirectory(server/site)

if(MUSTER_FUZZ)
    # tests/fuzz as the fuzz preset sees it: here the targets are built, in tests/ they are run.
    function(muster_fuzz_test name)
        add_executable(fuzz_${name} ${name}.c)
        set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
        target_link_libraries(fuzz_${name} PRIVATE ${ARGN})
        target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    endfunction()
    add_subdirectory(tests/fuzz)
else()
    add_subdirectory(firmware/native robot/native)
    add_subdirectory(server/calibration)
    add_subdirectory(server/record)
    add_subdirectory(sim)
    add_subdirectory(sim/live)
    add_subdirectory(server/serve)
    add_subdirectory(server)
    include(Package)

    if(BUILD_TESTING)
        enable_testing()
        add_subdirectory(tests)
    endif()
endif()
