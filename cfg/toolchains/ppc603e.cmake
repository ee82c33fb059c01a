# Linux programs for the PowerPC 603e, linked statically, run by user-mode emulation (Debian: g++-powerpc-linux-gnu, qemu-user).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ppc)
include(${CMAKE_CURRENT_LIST_DIR}/compiler.cmake)
lasso_compiler(powerpc-linux-gnu-g++ g++-powerpc-linux-gnu)
set(CMAKE_CXX_FLAGS_INIT "-mcpu=603e")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_CXX_STANDARD_LIBRARIES_INIT "-latomic")  # 64-bit atomics are calls on a 32-bit processor
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-ppc -cpu 603e)

# A processor without a floating-point unit, whose arithmetic is that of a library (ft/ppc603e/soft_float). The C library remains one for the unit: no
# floating-point number may be handed to it, and the linker must not mind.
set(LASSO_SOFT_FLOAT "" CACHE FILEPATH "Library of floating-point arithmetic: compile for a processor that has none")
if(LASSO_SOFT_FLOAT)
  string(APPEND CMAKE_CXX_FLAGS_INIT " -msoft-float")
  string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,--no-warn-mismatch")
  string(PREPEND CMAKE_CXX_STANDARD_LIBRARIES_INIT "${LASSO_SOFT_FLOAT} ")
endif()

# Libraries of the target only; CMake packages of the host too, for those that are headers alone (Eigen).
set(CMAKE_FIND_ROOT_PATH /usr/powerpc-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)

set(CMAKE_CXX_LINK_EXECUTABLE
    "<CMAKE_CXX_COMPILER> <FLAGS> <CMAKE_CXX_LINK_FLAGS> <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>"
    "${CMAKE_CURRENT_LIST_DIR}/replace_mffscrn <TARGET>")
