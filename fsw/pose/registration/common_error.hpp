// What errors that all rays of a scan have in common do to its pose: a calibration that is off does not average out over the rays.
//
// Common errors are independent of each other, of 1 sigma each, and of mean 0:
//   0     along each ray, sensor.common_sigma_m + sensor.common_sigma_k_per_m R^2, R the measured range
//   1..3  turns of all rays about the sensor's x, y and z, sensor.common_sigma_deg
#pragma once

#include "fsw/geometry/types.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

// Does the mission state any?
bool has_common_errors(const MissionParameters& parameters);

// What the hits know of the pose.
struct KnownPose {
  Pose T_target_sensor;
  Mat6 covariance = Mat6::Zero();  // of the step x (rotation, translation) in target axes
  double noise_scale = 1;          // of the noise's variance over the assumed one, as residuals show it
  double trust_scale = 1;          // the same as the covariance takes it (estimation.noise_estimated)
  double range_sigma_m = 0;        // of the stated noise, at the target; > 0
};

// The step x of T_target_sensor that 1 sigma of the common range error makes: the covariance times what it changes of the gradient, by
// central differences. All points are moved along their rays, by a quarter of the range's noise, and back, to within rounding. Tukey's
// weights make the gradient of noisy points less steep than the information says; for Gaussian noise by a known factor, which is made good.
// No longer than four times the error at the model's radius: what is longer is of a direction that the hits do not show. Two passes.
Vec6 range_step(const Mission& mission, const KnownPose& hits, Workspace& workspace);

// The same step after other measurements have made `before` of its covariance, the step's own square in it, into `after`; zero where
// `before` has no inverse.
Vec6 step_after(const Vec6& step, const Mat6& before, const Mat6& after);

// d pose / d error in sensor axes, rotation and translation of the target's origin, column by column. Turns move the target exactly with
// them, its contours as well.
CommonErrors common_errors(const MissionParameters& parameters, const Pose& T_target_sensor, const Vec6& range_step);

}  // namespace lasso
