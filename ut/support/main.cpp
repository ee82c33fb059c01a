// Common entry of the unit tests: an invariant that fails ends the process, so that death tests can see it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "fsw/core/invariant.hpp"

// make coverage and make mcdc name the function that writes the counts: a process that aborts leaves none by itself.
#ifdef LASSO_BEFORE_ABORT
extern "C" int LASSO_BEFORE_ABORT();
#else
static void LASSO_BEFORE_ABORT() {}
#endif

namespace lasso {
[[noreturn]] void on_invariant_failure(const InvariantFailure& failure) {
  std::fprintf(stderr, "invariant failed: %s, of APID %u, context %p\n", failure.what, static_cast<unsigned>(failure.apid),
               failure.context);
  LASSO_BEFORE_ABORT();
  std::abort();
}
}  // namespace lasso

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
