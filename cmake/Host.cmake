# The host's half of the tree: muster itself and the tests.

option(BUILD_TESTING "Build the tests (they need Unity: make deps)" ON)
option(MUSTER_FUZZ "Build the fuzz targets, and nothing else (needs clang)" OFF)
set(MUSTER_SANITIZE "" CACHE STRING "What -fsanitize= is given, such as address,undefined")

# Where the firmware preset leaves its images: what muster sim runs unless told otherwise, and
# what the tests run.
set(MUSTER_FIRMWARE_DIR ${PROJECT_SOURCE_DIR}/build/firmware)

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(FYAML REQUIRED IMPORTED_TARGET libfyaml)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)

# Assertions stay on. Native robots have to give the chip's bits on every machine: no contraction
# of a*b+c, and nothing that depends on the processor at hand.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g")
add_compile_options(-ffp-contract=off)
if(MUSTER_SANITIZE)
    add_compile_options(-fsanitize=${MUSTER_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${MUSTER_SANITIZE})
endif()

# The robot's rooms get folders of their own: build/firmware belongs to the firmware preset.
set(rooms common firmware/core firmware/native server/core server/scenario sim server)
if(MUSTER_FUZZ)
    set(rooms common server/core server/scenario)
endif()
foreach(room IN LISTS rooms)
    if(EXISTS ${PROJECT_SOURCE_DIR}/${room}/CMakeLists.txt)
        string(REPLACE firmware robot binary_dir ${room})
        add_subdirectory(${room} ${binary_dir})
    endif()
endforeach()

if(BUILD_TESTING)
    enable_testing()
    if(EXISTS ${PROJECT_SOURCE_DIR}/tests/CMakeLists.txt)
        add_subdirectory(tests)
    endif()
endif()
