#include "fsw/exec/named_pose.hpp"

#include "fsw/exec/wire_values.hpp"

namespace lasso {
namespace {

constexpr int kRotation = 0, kTranslation = 3, kOmega = 6, kVelocity = 9;  // where they begin

// From the target's origin to that of `of`, sensor axes.
Vec3 lever(const NamedFrame& frame, const Pose& T_sensor_target) { return rotate(T_sensor_target.q, frame.T_target_of.p); }

// What the errors of the first rows do to the others, by the lever r: with r' = r + rotation x r, the origin is off by rotation x r more,
// and its velocity omega x r by omega' x r + omega x (rotation x r).
void add_lever(const Vec3& r, const Vec3& omega_radps, Mat12& rows) {
  const Mat3 arm = -skew(r);
  const Mat3 turning = skew(omega_radps) * arm;
  rows.middleRows<3>(kTranslation) += arm * rows.middleRows<3>(kRotation);
  rows.middleRows<3>(kVelocity) += turning * rows.middleRows<3>(kRotation);
  rows.middleRows<3>(kVelocity) += arm * rows.middleRows<3>(kOmega);
}

// Each block of three is turned.
void turn(const Mat3& R, Mat12& rows) {
  for (const int first : {kRotation, kTranslation, kOmega, kVelocity}) {
    const Eigen::Matrix<double, 3, 12> turned = R * rows.middleRows<3>(first);
    rows.middleRows<3>(first) = turned;
  }
}

Pose pose_in(const NamedFrame& frame, const Pose& T_sensor_target) { return frame.T_in_sensor * T_sensor_target * frame.T_target_of; }

Mat12 as_states(const Mat6& covariance) {
  Mat12 states = Mat12::Zero();
  states.topLeftCorner<6, 6>() = covariance;
  return states;
}

}  // namespace

// J C J^T as J (J C)^T: C is symmetric, and so is the result but for rounding, of which the upper triangle is reported.
Mat12 covariance_in(const NamedFrame& frame, const Pose& T_sensor_target, const Vec3& omega_radps, const Mat12& covariance) {
  const Vec3 r = lever(frame, T_sensor_target);
  const Mat3 R = to_matrix(frame.T_in_sensor.q);
  Mat12 moved = covariance;
  for (int side = 0; side < 2; ++side) {
    add_lever(r, omega_radps, moved);
    turn(R, moved);
    moved.transposeInPlace();
  }
  return moved;
}

Twist rates_in(const NamedFrame& frame, const Pose& T_sensor_target, const Twist& rates) {
  Twist moved;
  moved.omega_radps = rotate(frame.T_in_sensor.q, rates.omega_radps);
  moved.v_mps = rotate(frame.T_in_sensor.q, rates.v_mps + rates.omega_radps.cross(lever(frame, T_sensor_target)));
  return moved;
}

NamedPoseTelemetry make_named_pose_report(const NamedFrame& frame, const Registration& registration, const FilterState& filter) {
  NamedPoseTelemetry out;
  out.scan_id = registration.scan_id;
  out.t_measurement_us = registration.t_us;
  out.valid = registration.valid() ? 1 : 0;
  copy_pose(pose_in(frame, registration.T_sensor_target), out.q_in_of, out.p_in_of_m);
  const Mat12 measured = covariance_in(frame, registration.T_sensor_target, Vec3::Zero(), as_states(registration.covariance));
  const Mat6 of_pose = measured.topLeftCorner<6, 6>();
  copy_upper_triangle(of_pose, Span<float>(out.covariance));
  out.started = filter.initialised ? 1 : 0;
  out.t_filter_us = filter.t_us;
  copy_pose(pose_in(frame, filter.T_sensor_target), out.filter_q_in_of, out.filter_p_in_of_m);
  const Twist rates = rates_in(frame, filter.T_sensor_target, filter.rates);
  for (int i = 0; i < 3; ++i) {
    out.filter_omega_radps[i] = rates.omega_radps[i];
    out.filter_v_mps[i] = rates.v_mps[i];
  }
  const Mat12 filtered = covariance_in(frame, filter.T_sensor_target, filter.rates.omega_radps, filter.covariance);
  copy_upper_triangle(filtered, Span<float>(out.filter_covariance));
  return out;
}

}  // namespace lasso
