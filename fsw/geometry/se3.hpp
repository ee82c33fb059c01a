// Rigid transforms. T_a_b takes coordinates in b to coordinates in a, so that T_a_c = T_a_b * T_b_c.
#pragma once

#include "fsw/geometry/so3.hpp"

namespace lasso {

struct Pose {
  Quat q = Quat(1, 0, 0, 0);  // (w, x, y, z) constructor order of Eigen; stored x, y, z, w
  Vec3 p = Vec3::Zero();      // m

  Vec3 operator*(const Vec3& v) const { return rotate(q, v) + p; }
};

Pose operator*(const Pose& T_a_b, const Pose& T_b_c);
Pose inverse(const Pose& T_a_b);

// Motion of the target as the sensor sees it: rates of T_sensor_target.
struct Twist {
  Vec3 omega_radps = Vec3::Zero();  // angular velocity, sensor axes
  Vec3 v_mps = Vec3::Zero();        // velocity of the target's origin, sensor axes
};

// T_sensor_target after dt: constant velocity of the origin, constant angular velocity in sensor axes.
Pose propagate(const Pose& T_sensor_target, const Twist& rates, double dt_s);

// Error of `estimate` against `truth`, as (rotation vector in sensor axes [rad], translation of the origin [m]):
// estimate.q = exp(rotation) * truth.q, estimate.p = truth.p + translation.
Vec6 pose_difference(const Pose& estimate, const Pose& truth);

bool is_valid(const Pose& pose);  // finite, |q| within 1e-6 of 1

}  // namespace lasso
