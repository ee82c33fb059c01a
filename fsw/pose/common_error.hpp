// What errors that all rays of a scan have in common do to its pose: a calibration that is off does not average out over the rays.
//
// Common errors are independent of each other, of 1 sigma each, and of mean 0:
//   0     along each ray, sensor.common_sigma_m + sensor.common_sigma_k_per_m R^2, R the measured range
//   1..3  turns of all rays about the sensor's x, y and z, sensor.common_sigma_deg
#pragma once

#include "fsw/geometry/types.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

// Does the mission state any?
bool has_common_errors(const MissionParameters& parameters);

// What the pose is known by: its covariance in target axes (rows as HitSolution::H), and by how much the noise's variance exceeds the
// assumed one.
struct KnownPose {
  Pose T_target_sensor;
  Mat6 covariance = Mat6::Zero();
  double noise_scale = 1;
  double range_sigma_m = 0;  // of the stated noise, at the target; > 0
};

// d pose / d error: the pose's error in sensor axes, rotation and translation of the target's origin, by each of the errors, column by
// column. Turns move the target exactly with them. A range error moves the pose by the covariance times what it
// changes of the gradient, by central differences of a quarter of the range's noise: two passes over all points, which are moved along
// their rays, and back. Labels hold against it as far as they shrink the covariance.
CommonErrors common_errors(const Mission& mission, const KnownPose& pose, Workspace& workspace);

}  // namespace lasso
