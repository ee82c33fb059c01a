// The safe reaction of this board to a bug: say where, and end the process.
#include "fsw/core/invariant.hpp"

#include <cstdio>
#include <cstdlib>

namespace lasso {

[[noreturn]] void on_invariant_failure(const char* what) {
  (void)std::fprintf(stderr, "3dlasso: invariant failed: %s\n", what);
  std::abort();
}

}  // namespace lasso
