// The time base as the component's time, and the wake-up call that ends the wait for the next slot.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"

namespace lasso::bare {

class Clock {
 public:
  explicit Clock(std::uint32_t ticks_per_s) : hz_(ticks_per_s) {}

  void set(TimeUs now_us);
  TimeUs now_us() const { return offset_us_ + us_of(ticks()); }
  // Of the time base, without the times for which the clock stood still.
  std::uint64_t ticks() const;
  std::uint64_t ticks_at(TimeUs t_us) const;
  std::uint64_t ticks_in(DurationUs dt_us) const;

  // The rig's: time stands still while the rest of the world catches up.
  void stop();
  void go_on();
  // ... or is at t_us at once, because nothing is to be done until then. Returns the ticks.
  std::uint64_t skip_to(TimeUs t_us);

  // An interrupt at that time, at once if it is past.
  void wake_at(TimeUs t_us) const;

 private:
  DurationUs us_of(std::uint64_t ticks) const;

  std::uint32_t hz_;
  TimeUs offset_us_ = 0;
  std::uint64_t zero_ = 0;     // of the time base, when the clock was set
  std::uint64_t stopped_ = 0;  // when it stopped; 0: it goes
};

}  // namespace lasso::bare
