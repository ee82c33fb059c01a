// Invariants catch bugs of this component, never bad input (which is validated, see status.hpp). They are never compiled out.
#pragma once

#include <cstdint>

#include "fsw/core/identity.hpp"

namespace lasso {

struct InvariantFailure {
  const char* what;    // did not hold: a few words, never null
  std::uint16_t apid;  // of the component that ran in this thread; 0: none did
  void* context;       // of its Identity; null where there was none
};

// Provided by the board support package (or by a test): records the place and ends in the board's safe reaction. Never returns.
[[noreturn]] void on_invariant_failure(const InvariantFailure& failure);

// Calls the above with whose code runs.
[[noreturn]] void fail_invariant(const char* what);

inline void invariant(bool holds, const char* what) {
  if (!holds) fail_invariant(what);
}

// While it lives, this thread runs that component's code. One within another hides it. The identity outlives it.
class Running {
 public:
  explicit Running(const Identity& identity);
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  const Identity* outer_;
};

}  // namespace lasso
