// A watchdog on Linux: a timer of the kernel's, wound up anew by each feed. Where the feeds stay away it kills the process with SIGABRT,
// whatever the threads are doing; whoever started the process sees that, and starts it again (ResetCause::kWatchdog).
#pragma once

#include <ctime>

#include "fsw/core/time.hpp"
#include "fsw/exec/watchdog.hpp"

namespace lasso::posix {

class TimerWatchdog final : public Watchdog {
 public:
  // Runs from the first feed on. Throws std::system_error where the kernel gives no timer. `patience_us`: more than two frames.
  explicit TimerWatchdog(DurationUs patience_us);
  ~TimerWatchdog();  // stops it
  TimerWatchdog(const TimerWatchdog&) = delete;
  TimerWatchdog& operator=(const TimerWatchdog&) = delete;

  void feed() override;

 private:
  DurationUs patience_us_;
  timer_t timer_{};
};

}  // namespace lasso::posix
