// Whether a head scans what it was asked to: its mirrors and its samples' times against the plan.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_lcs/clock_tie.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::lcs {

constexpr std::uint16_t kRaysPerPlanCheck = kSamplesPerFrame;

inline bool within_mirror_tolerance(double off) { return off < kMirrorTolerance && off > -kMirrorTolerance; }

// A ray that was not aimed in time is where it should be. `ray` is below the valid plan's points.
inline bool follows_plan(const ScanPlan& plan, std::uint16_t ray, const RawSample& raw, const Mirrors& mirrors) {
  if (raw.kind == SampleKind::kNotAimed) return true;
  const Vec3 planned = pattern_direction(plan, ray);
  const double off_x = tangent(raw.angle_x_rad + mirrors.x_offset_rad) - planned.x() / planned.z();
  const double off_y = tangent(raw.angle_y_rad + mirrors.y_offset_rad) - planned.y() / planned.z();
  return within_mirror_tolerance(off_x) && within_mirror_tolerance(off_y);
}

// Whether the ray's sample may be of t_us, in a scan whose first one was due at first_us, and whose last one so far is of last_us. It is
// not before that one, nor farther than the tolerance from its plan.
inline bool follows_time(const ScanPlan& plan, std::uint16_t ray, TimeUs first_us, TimeUs last_us, TimeUs t_us) {
  const DurationUs late_us = t_us - (first_us + pattern_time_us(plan, ray));
  return t_us >= last_us && late_us <= kClockToleranceUs && late_us >= -kClockToleranceUs;
}

// A sample that makes no statement.
inline RangeSample invalid_sample(TimeUs t_us) {
  RangeSample sample;
  sample.t_us = t_us;
  return sample;
}

}  // namespace lasso::lcs
