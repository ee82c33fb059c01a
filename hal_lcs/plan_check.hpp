// Whether a head scans what it was asked to: its mirrors against the plan.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"
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

}  // namespace lasso::lcs
