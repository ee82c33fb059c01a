// What came back from a scan: one sample per ray, hits and misses alike. Sensor frame, metres.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/time.hpp"
#include "fsw/mission/calibration.hpp"

namespace lasso {

enum class RayState : std::uint8_t {
  kHit = 0,      // range_m is a measurement
  kMiss = 1,     // the sensor looked and nothing returned
  kInvalid = 2,  // no statement (saturated, damaged, outside the sensor's limits)
  kLost = 3,     // from a sensor only: measured, but it never arrived. An image holds it as kInvalid
};

struct RangeSample {
  float direction[3] = {0, 0, 1};  // unit vector of the ray at its own time
  float range_m = 0;               // along the ray; 0 unless a hit
  TimeUs t_us = 0;                 // time of this sample
  float sigma_factor = 1;          // [1, kMaxSigmaFactor]: by how much the noise of this range is larger than the sensor's
  RayState state = RayState::kInvalid;
};

struct RangeImage {
  std::uint32_t scan_id = 0;
  bool misses_known = true;       // false: only hits were recorded (point clouds), a ray not listed says nothing
  std::uint16_t aimed_first = 0;  // samples of rays that left the pattern for contours
  std::uint16_t aimed_count = 0;
  FixedVector<RangeSample, kMaxRays> samples;

  bool is_aimed(std::size_t sample) const { return sample - aimed_first < aimed_count; }  // below the first, the difference wraps

  // The scan's reference time: the middle between its first and last sample. Samples are in time order. 0 when empty.
  TimeUs reference_time_us() const {
    if (samples.empty()) return 0;
    const TimeUs first = samples[0].t_us;
    return first + (samples[samples.size() - 1].t_us - first) / 2;
  }
};

}  // namespace lasso
