set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR avr)

set(CMAKE_C_COMPILER avr-gcc)
set(CMAKE_C_FLAGS_INIT "-mmcu=atmega128")
set(CMAKE_ASM_FLAGS_INIT "-mmcu=atmega128")

# A program cannot be linked before there is a main for this chip.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
