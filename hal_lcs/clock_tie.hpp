// What the camera's clock showed at a time of the component's: by that its stamps, microseconds modulo 2^32, become times.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"

namespace lasso::lcs {

constexpr DurationUs kClockToleranceUs = 5'000;  // of the camera's clock from scan to scan, and of a sample from its plan
constexpr DurationUs kTieUs = 10'000'000;        // as long a tie of the clocks serves scans whose answer was damaged

class ClockTie {
 public:
  void tie(std::uint32_t clock_us, TimeUs t_us) {
    known_ = true;
    at_us_ = t_us;
    clock_us_ = clock_us;
  }
  void forget() { known_ = false; }

  // May a scan that starts at t_us be timed by it? Not one from farther before the tie than the tolerance: our own clock was set back then.
  bool serves(TimeUs t_us) const { return known_ && t_us - at_us_ >= -kClockToleranceUs && t_us - at_us_ < kTieUs; }
  // Has the camera's clock gone otherwise than ours since they were tied? Modulo its wrap, and with a thousandth of drift.
  bool jumped(std::uint32_t clock_us, TimeUs t_us) const {
    if (!known_) return false;
    const DurationUs elapsed_us = t_us - at_us_;
    const std::int64_t off_us = static_cast<std::int32_t>(clock_us - clock_us_ - static_cast<std::uint32_t>(elapsed_us));
    const DurationUs tolerance_us = kClockToleranceUs + elapsed_us / 1000;
    return off_us > tolerance_us || off_us < -tolerance_us;
  }
  TimeUs time_of(std::uint32_t clock_us) const { return at_us_ + static_cast<std::int32_t>(clock_us - clock_us_); }

 private:
  bool known_ = false;
  TimeUs at_us_ = 0;  // when the camera's clock showed clock_us_
  std::uint32_t clock_us_ = 0;
};

}  // namespace lasso::lcs
