# Compiler settings. The flight component gives the same bits everywhere: no contraction, no vectorised Eigen, no errno in square roots.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

add_library(lasso_warnings INTERFACE)
target_compile_options(lasso_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wold-style-cast
                                                -Wuseless-cast -Wshadow -Wnon-virtual-dtor -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(lasso_warnings INTERFACE -Wno-unknown-warning-option)
endif()

add_library(lasso_flight INTERFACE)
target_compile_features(lasso_flight INTERFACE cxx_std_17)
target_compile_options(lasso_flight INTERFACE -ffp-contract=off -fno-math-errno -fno-exceptions -fno-rtti -fno-threadsafe-statics)
target_compile_definitions(lasso_flight INTERFACE EIGEN_DONT_VECTORIZE EIGEN_NO_DEBUG)
target_include_directories(lasso_flight INTERFACE ${PROJECT_SOURCE_DIR})
get_target_property(LASSO_EIGEN_INCLUDE Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(lasso_flight SYSTEM INTERFACE ${LASSO_EIGEN_INCLUDE})
