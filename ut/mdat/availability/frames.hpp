// Frames whose figures are known.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "mdat/availability/figures.hpp"

namespace lasso::mdat {

constexpr LightAt kDayLight{1, 3, 0.8}, kDuskLight{0.5, 3, 0.01}, kNightLight{0, 1, 0};

inline SeenFrame pose_in(const LightAt& light, double off_mm, double off_deg) {
  SeenFrame seen;
  seen.light = light;
  seen.error.reported = seen.error.valid = true;
  seen.error.reason = PoseReason::kValid;
  seen.error.registration.translation_m = 1e-3 * off_mm * Vec3(2, -1, 2) / 3;
  seen.error.registration.rotation_rad = off_deg * kRadPerDeg;
  seen.error.nees = off_mm;
  return seen;
}
inline SeenFrame wrong_in(const LightAt& light) {
  SeenFrame seen = pose_in(light, 900, 90);
  seen.error.wrong = true;
  return seen;
}
inline SeenFrame nothing_in(const LightAt& light) { return {FrameError{}, light}; }

}  // namespace lasso::mdat
