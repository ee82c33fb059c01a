# The flight image for the bare board with a PowerPC 603e: no operating system, no library but libgcc (Debian: g++-powerpc-linux-gnu).
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/compiler.cmake)
set(CMAKE_SYSTEM_PROCESSOR ppc)
lasso_compiler(powerpc-linux-gnu-g++ g++-powerpc-linux-gnu)
if(NOT LASSO_LINT)  # clang reads the sources for make lint, and does not know it
  set(NO_SMALL_DATA -msdata=none)
endif()
set(CMAKE_CXX_FLAGS_INIT
    "-mcpu=603e -fno-pic -fno-pie ${NO_SMALL_DATA} -fno-asynchronous-unwind-tables -fno-stack-protector -ffunction-sections -fdata-sections")
if(LASSO_CALL_GRAPH)  # for make prove, in each object, so that a compiler cache keeps it; ccache does not know that the script decides, too
  string(APPEND CMAKE_CXX_FLAGS_INIT " -fcallgraph-info=su")
  set(KEEP ${CMAKE_CURRENT_LIST_DIR}/keep_call_graph)
  find_program(LASSO_CCACHE ccache)
  if(LASSO_CCACHE)
    set(KEEP env CCACHE_PREFIX=${KEEP} CCACHE_EXTRAFILES=${KEEP} ${LASSO_CCACHE})
  endif()
  set(CMAKE_CXX_COMPILER_LAUNCHER ${KEEP} CACHE STRING "How the compiler is started" FORCE)
endif()
set(CMAKE_ASM_FLAGS_INIT "-mcpu=603e -x assembler-with-cpp")
set(CMAKE_FIND_ROOT_PATH /usr/powerpc-linux-gnu)
set(LASSO_BOARD ppc603e CACHE STRING "Board to build for" FORCE)
