// The safe reaction of this board to a bug: say where, and end the process.
#include "fsw/core/invariant.hpp"

#include <cstdio>
#include <cstdlib>

namespace lasso {

[[noreturn]] void on_invariant_failure(const InvariantFailure& failure) {
  (void)std::fprintf(stderr, "3dlasso: invariant failed: %s (APID 0x%03X)\n", failure.what, static_cast<unsigned>(failure.apid));
  std::abort();
}

}  // namespace lasso
