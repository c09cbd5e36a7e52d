# The Zynq-7000's Cortex-A9 without operating system, with Debian's gcc-arm-none-eabi.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# There is nothing yet that a test program could be linked with.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(chip_flags "-mcpu=cortex-a9 -mfpu=neon-vfpv3 -mfloat-abi=hard -marm")
set(CMAKE_ASM_FLAGS_INIT "${chip_flags}")
set(CMAKE_C_FLAGS_INIT "${chip_flags}")
set(CMAKE_CXX_FLAGS_INIT "${chip_flags}")
