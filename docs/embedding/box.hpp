// What a scanner measures of a box of 0.6 m x 0.4 m x 0.24 m, the target of the examples (README.md).
#pragma once

#include "fsw/exec/lasso.hpp"

// The sample of a ray with direction `u` (unit vector, sensor frame) at t_us, without noise: in closed form, by the slabs of the box.
inline lasso::RangeSample measure_box(const lasso::Pose& T_sensor_target, const lasso::Vec3& u, lasso::TimeUs t_us) {
  const lasso::Pose T_target_sensor = lasso::inverse(T_sensor_target);
  const lasso::Vec3 d = lasso::rotate(T_target_sensor.q, u);
  const lasso::Vec3 to_center = lasso::Vec3(0.02, -0.01, 0.03) - T_target_sensor.p;
  const lasso::Vec3 half(0.30, 0.20, 0.12);
  const lasso::Vec3 a = (to_center - half).cwiseQuotient(d);
  const lasso::Vec3 b = (to_center + half).cwiseQuotient(d);
  const double range_m = a.cwiseMin(b).maxCoeff();
  lasso::RangeSample sample;
  for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(u[i]);
  sample.t_us = t_us;
  sample.state = range_m < a.cwiseMax(b).minCoeff() ? lasso::RayState::kHit : lasso::RayState::kMiss;
  sample.range_m = sample.state == lasso::RayState::kHit ? static_cast<float>(range_m) : 0.0f;
  return sample;
}

// Where the box stands.
inline lasso::Pose box_pose() { return {lasso::normalized(lasso::Quat(0.8, 0.3, -0.4, 0.35)), lasso::Vec3(0.05, -0.04, 2.5)}; }
