#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "fsw/core/invariant.hpp"
#include "ft/port/board.hpp"

namespace lasso {

[[noreturn]] void on_invariant_failure(const InvariantFailure& failure) {
  std::printf("FAILED  an invariant did not hold: %s\n", failure.what);
  std::abort();
}

namespace port {

using Clock = std::chrono::steady_clock;

TimeUs now_us() { return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count(); }

void sleep_until(TimeUs t_us) { std::this_thread::sleep_until(Clock::time_point(std::chrono::microseconds(t_us))); }

const char* name() { return "POSIX, by the clock and the sleep of C++"; }

}  // namespace port
}  // namespace lasso
