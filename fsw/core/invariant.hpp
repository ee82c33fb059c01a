// Invariants catch bugs of this component, never bad input (which is validated, see status.hpp). They are never compiled out.
#pragma once

namespace lasso {

// Provided by the board support package (or by a test): records the place and ends in the board's safe reaction. Never returns.
[[noreturn]] void on_invariant_failure(const char* what);

inline void invariant(bool holds, const char* what) {
  if (!holds) on_invariant_failure(what);
}

}  // namespace lasso
