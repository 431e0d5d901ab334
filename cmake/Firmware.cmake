# The robot's half of the tree: the image for the ATmega128, and the images of tests/avr
# and tests/bench.

set(MUSTER_F_CPU 16000000 CACHE STRING "The robot's crystal in Hz: 16000000 or 14745600")
set(MUSTER_BAUD 115200 CACHE STRING "Speed of the robot's radio link in baud")

set_property(CACHE MUSTER_F_CPU PROPERTY STRINGS 16000000 14745600)
if(NOT MUSTER_F_CPU MATCHES "^(16000000|14745600)$")
    message(FATAL_ERROR "MUSTER_F_CPU is '${MUSTER_F_CPU}'; 16000000 and 14745600 are allowed")
endif()
if(NOT MUSTER_BAUD MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "MUSTER_BAUD is '${MUSTER_BAUD}'; a number of baud such as 115200 is allowed")
endif()

enable_language(ASM)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_FLAGS_MINSIZEREL "-Os -g")
# What makes this compiler's code for this chip small, found by trying.
add_compile_options(-ffunction-sections -fdata-sections -fstack-usage
    -mrelax -mstrict-X -mcall-prologues -fira-algorithm=priority -fno-early-inlining
    -fno-ivopts -fno-jump-tables -fno-move-loop-invariants)
add_link_options(-Wl,--gc-sections -mrelax)
add_compile_definitions(F_CPU=${MUSTER_F_CPU}UL BAUD=${MUSTER_BAUD}UL)

# muster_avr_image(<target> <source>...): links <target>.elf, and refuses one that simavr 1.6
# would execute wrongly.
function(muster_avr_image target)
    add_executable(${target} ${ARGN})
    set_target_properties(${target} PROPERTIES SUFFIX .elf)
    add_custom_command(TARGET ${target} POST_BUILD VERBATIM
        COMMAND ${PROJECT_SOURCE_DIR}/cmake/scan-skips.sh ${CMAKE_OBJDUMP} $<TARGET_FILE:${target}>)
    set_property(TARGET ${target} APPEND PROPERTY
        LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/scan-skips.sh)
endfunction()

# muster_seal(<target>): makes of an image a program that the boot loader starts, with its seal at
# SEAL_AT (common/flash_map.h).
function(muster_seal target)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/firmware/atmega128/seal.c)
    target_link_options(${target} PRIVATE
        -Wl,--section-start=.seal=0xFBF8 -Wl,--undefined=program_seal)
    add_custom_command(TARGET ${target} POST_BUILD VERBATIM
        COMMAND ${PROJECT_SOURCE_DIR}/cmake/seal.sh ${CMAKE_OBJCOPY} $<TARGET_FILE:${target}>)
    set_property(TARGET ${target} APPEND PROPERTY
        LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/seal.sh)
endfunction()

# tests/avr as this half sees it: here the images are linked, in tests/ they are judged.
function(muster_avr_test name)
    muster_avr_image(avr_${name} ${name}.avr.c)
    set_target_properties(avr_${name} PROPERTIES
        OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    target_include_directories(avr_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/vectors)
    target_link_libraries(avr_${name} PRIVATE muster_board)
endfunction()

add_subdirectory(common)
add_subdirectory(firmware/core)
add_subdirectory(firmware/atmega128)
add_subdirectory(firmware/loader)
add_subdirectory(tests/avr)
add_subdirectory(tests/bench)
add_subdirectory(tests/loader)
