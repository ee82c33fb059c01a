# Compiler settings. The flight component gives the same bits everywhere: no contraction, no vectorised Eigen, no errno in square roots.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
get_target_property(LASSO_EIGEN_INCLUDE Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
include(GNUInstallDirs)
set(LASSO_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/3dlasso)
option(LASSO_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})

# Host and target are compiled at the level at which the component is verified, unless the caller gives flags.
if(CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")  # flight rooms are built with -O3, see lasso_flight
endif()

# A header that clang precompiled names the folder of its sources: from the compiler cache it would be unusable once that folder is gone.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# For make sanitize: a finding ends the program. Flight code has no type information, which the check of virtual calls would need.
set(LASSO_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize= names them")
if(LASSO_SANITIZE)
  add_compile_options(-fsanitize=${LASSO_SANITIZE} -fno-sanitize=vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LASSO_SANITIZE})
  if(LASSO_SANITIZE MATCHES "fuzzer")  # it would record the operands of each comparison: two thirds of the time, and nothing more is found
    add_compile_options(-fno-sanitize-coverage=trace-cmp)
  endif()
endif()

# For make mcdc: counters (-fprofile-instr-generate, said so that ccache does not take it for a path) of lines, branches and conditions of what cfg/quality/mcdc.list names. All paths are relative to the build folder, so that the
# compiler cache hits in any clone.
option(LASSO_COUNT "Count lines, branches and conditions (clang)" OFF)
if(LASSO_COUNT)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../quality/mcdc.list ${CMAKE_BINARY_DIR}/mcdc.list COPYONLY)
  file(SHA256 ${CMAKE_BINARY_DIR}/mcdc.list LIST)  # neither ninja nor ccache knows that an object depends on it
  add_compile_definitions(LASSO_COUNTED=0x${LIST})
  foreach(OPTION -fprofile-instrument=clang -fprofile-list=mcdc.list -fcoverage-mapping -fcoverage-mcdc -fcoverage-compilation-dir=.)
    add_compile_options("SHELL:-Xclang ${OPTION}")
  endforeach()
  add_link_options(-fprofile-instr-generate)
  add_compile_definitions(LASSO_BEFORE_ABORT=__llvm_profile_write_file)
endif()

# For tests, rigs and mdat's command line, which compute little themselves: half of an optimised build's time would go into making them faster.
add_library(lasso_quick INTERFACE)
target_compile_options(lasso_quick INTERFACE $<$<CONFIG:Release>:-O1>)

# Of mdat's command line and of the tests that call it, which compute nothing: with sanitizers, most of their build's time would go into making them faster.
set(LASSO_COMMAND_LINE_OPTIONS "" CACHE STRING "Compiler options of mdat's command line and of the tests that call it")

add_library(lasso_warnings INTERFACE)
target_compile_options(lasso_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wold-style-cast
                                                -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SIZEOF_VOID_P EQUAL 8)  # a cast to std::size_t that the host needs is useless on a 32-bit target
  target_compile_options(lasso_warnings INTERFACE -Wuseless-cast)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")  # GCC 12's std::stable_sort calls what its own header calls deprecated
  target_compile_options(lasso_warnings INTERFACE -Wno-deprecated-declarations)
endif()
if(LASSO_WERROR)
  target_compile_options(lasso_warnings INTERFACE -Werror)
endif()

# After lasso_warnings, for unit tests: sizes that are right on the host need no casts for the 32-bit target. Flight sources get no such leave.
add_library(lasso_test_leave INTERFACE)
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
  target_compile_options(lasso_test_leave INTERFACE -Wno-conversion -Wno-sign-conversion)
endif()

# For everyone who compiles the flight headers: the linker keeps one copy of an inline function, and may take it from any of them.
add_library(lasso_same_bits INTERFACE)
target_compile_options(lasso_same_bits INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
target_compile_definitions(lasso_same_bits INTERFACE EIGEN_DONT_VECTORIZE EIGEN_UNROLLING_LIMIT=40)
# The number type of the per-point path (fsw/geometry/number.hpp, docs/decisions/fixed-point.md).
set(LASSO_NUMBER float CACHE STRING "Number type of the per-point path: float or fixed")
set_property(CACHE LASSO_NUMBER PROPERTY STRINGS float fixed)
if(LASSO_NUMBER STREQUAL "fixed")
  target_compile_definitions(lasso_same_bits INTERFACE LASSO_FIXED_POINT)
elseif(NOT LASSO_NUMBER STREQUAL "float")
  message(FATAL_ERROR "LASSO_NUMBER is float or fixed, not \"${LASSO_NUMBER}\"")
endif()
target_compile_features(lasso_same_bits INTERFACE cxx_std_17)
target_link_libraries(lasso_same_bits INTERFACE Eigen3::Eigen)

# For the flight sources themselves.
add_library(lasso_flight INTERFACE)
target_compile_features(lasso_flight INTERFACE cxx_std_17)
# Unrolled sums are worth a fifth of the estimate; no value changes, as nothing is reassociated.
target_compile_options(lasso_flight INTERFACE $<$<CONFIG:Release>:$<IF:$<BOOL:$<TARGET_PROPERTY:LASSO_SMALL>>,-O2,-O3>>)
target_compile_options(lasso_flight INTERFACE -fno-math-errno -fno-exceptions -fno-rtti -fno-threadsafe-statics)
target_compile_definitions(lasso_flight INTERFACE EIGEN_NO_DEBUG)
target_include_directories(lasso_flight INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(lasso_flight INTERFACE lasso_same_bits)
