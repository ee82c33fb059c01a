// Whether a pose is right, as reqs/README.md says: wrong is what is off by more than 5 of its own sigma, in the direction of the error, and
// by more than 20 mm or 1 deg.
#pragma once

#include <cstdint>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/link/pose_telemetry.hpp"

namespace lasso::mdat {

constexpr double kWrong_m = 0.020;
constexpr double kWrong_rad = 1 * kRadPerDeg;
constexpr double kWrongSigmas = 5;

enum class PoseVerdict : std::uint8_t {
  kRight = 0,
  kCovered = 1,  // off by more than 20 mm or 1 deg, as its covariance admits
  kWrong = 2,    // or not finite
};
// `covariance` of (rotation, translation) in sensor axes.
PoseVerdict judge(const Pose& estimate, const Pose& truth, const Mat6& covariance);
// The worse of registration and filter, where the packet says valid.
PoseVerdict judge_valid(const PoseTelemetry& pose, const Pose& truth);

}  // namespace lasso::mdat
