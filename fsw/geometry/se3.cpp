#include "fsw/geometry/se3.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr double kUnitLengthTolerance = 1e-6;

}  // namespace

Pose operator*(const Pose& T_a_b, const Pose& T_b_c) {
  Pose T_a_c;
  T_a_c.q = T_a_b.q * T_b_c.q;
  T_a_c.p = rotate(T_a_b.q, T_b_c.p) + T_a_b.p;
  return T_a_c;
}

Pose inverse(const Pose& T_a_b) {
  Pose T_b_a;
  T_b_a.q = T_a_b.q.conjugate();
  T_b_a.p = -rotate(T_b_a.q, T_a_b.p);
  return T_b_a;
}

Pose propagate(const Pose& T_sensor_target, const Twist& rates, double dt_s) {
  const Vec3 rotation_rad = dt_s * rates.omega_radps;
  Pose later;
  later.q = normalized(exp_so3(rotation_rad) * T_sensor_target.q);  // frame after frame: rounding must not pile up
  later.p = T_sensor_target.p + dt_s * rates.v_mps;
  return later;
}

Vec6 pose_difference(const Pose& estimate, const Pose& truth) {
  Vec6 difference;
  difference.head<3>() = log_so3(estimate.q * truth.q.conjugate());
  difference.tail<3>() = estimate.p - truth.p;
  return difference;
}

bool is_valid(const Pose& pose) {
  bool finite = true;
  for (int i = 0; i < 4; ++i) finite = finite && is_finite(pose.q.coeffs()[i]);
  for (int i = 0; i < 3; ++i) finite = finite && is_finite(pose.p[i]);
  if (!finite) return false;
  const double error = square_root(pose.q.coeffs().squaredNorm()) - 1.0;
  return error <= kUnitLengthTolerance && error >= -kUnitLengthTolerance;
}

}  // namespace lasso
