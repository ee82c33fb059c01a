// Time on board: microseconds since the mission's epoch (TAI 1958-01-01 where the spacecraft provides it).
#pragma once

#include <cstdint>

namespace lasso {

using TimeUs = std::int64_t;      // an instant
using DurationUs = std::int64_t;  // a difference of instants

constexpr double kSecondsPerUs = 1e-6;
constexpr double to_seconds(DurationUs dt_us) { return static_cast<double>(dt_us) * kSecondsPerUs; }
// To the nearest microsecond; `seconds` is positive.
constexpr DurationUs to_us(double seconds) { return static_cast<DurationUs>(seconds * 1e6 + 0.5); }

}  // namespace lasso
