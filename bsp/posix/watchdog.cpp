#include "bsp/posix/watchdog.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <system_error>

namespace lasso::posix {

TimerWatchdog::TimerWatchdog(DurationUs patience_us) : patience_us_(patience_us) {
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGABRT;
  if (timer_create(CLOCK_MONOTONIC, &event, &timer_) != 0) throw std::system_error(errno, std::generic_category(), "timer_create");
}

TimerWatchdog::~TimerWatchdog() { static_cast<void>(timer_delete(timer_)); }

void TimerWatchdog::feed() {
  itimerspec once{};
  const std::chrono::microseconds patience(patience_us_);
  const auto whole = std::chrono::duration_cast<std::chrono::duration<std::time_t>>(patience);
  once.it_value.tv_sec = whole.count();
  once.it_value.tv_nsec = std::chrono::duration_cast<std::chrono::duration<long, std::nano>>(patience - whole).count();
  if (timer_settime(timer_, 0, &once, nullptr) != 0) std::abort();  // a watchdog that cannot be wound up has to bite
}

}  // namespace lasso::posix
