# The flight image for the bare board with an ARM Cortex-A9: no operating system, no library but libgcc (Debian: g++-arm-linux-gnueabihf). Doubles by
# the VFP, each product rounded before it is added; nothing by NEON, which has no doubles and flushes small numbers to zero. Accesses that are not aligned trap.
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/compiler.cmake)
set(CMAKE_SYSTEM_PROCESSOR arm)
lasso_compiler(arm-linux-gnueabihf-g++ g++-arm-linux-gnueabihf)
set(PROCESSOR "-mcpu=cortex-a9 -mfpu=vfpv3-d16 -mfloat-abi=hard")
set(CMAKE_CXX_FLAGS_INIT "${PROCESSOR} -mthumb -mno-unaligned-access -fno-pic -fno-pie -fno-asynchronous-unwind-tables -fno-unwind-tables \
-fno-stack-protector -ffunction-sections -fdata-sections")
set(CMAKE_ASM_FLAGS_INIT "${PROCESSOR} -x assembler-with-cpp")
set(CMAKE_CXX_STANDARD_LIBRARIES_INIT "-lgcc")  # behind all archives: none of its integer divisions is an instruction
set(CMAKE_FIND_ROOT_PATH /usr/arm-linux-gnueabihf)
set(LASSO_BOARD cortexa9 CACHE STRING "Board to build for" FORCE)
