// Common entry of the unit tests: an invariant that fails ends the process, so that death tests can see it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "fsw/core/invariant.hpp"

namespace lasso {
[[noreturn]] void on_invariant_failure(const char* what) {
  std::fprintf(stderr, "invariant failed: %s\n", what);
  std::abort();
}
}  // namespace lasso

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
