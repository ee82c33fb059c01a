#include "mdat/scene/torque_free.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::mdat::scene {
namespace {

// The least complement of the elliptic functions' parameter: with less, both kinds of tumbling cannot be told apart in doubles.
constexpr double kLeastComplement = 1e-30;
// A top that is this close to a principal axis, relative to its angular velocity, spins about it.
constexpr double kLeastWobble = 1e-100;

void check(const TorqueFree::Setup& setup, const Place& place) {
  Problems problems(place);
  const Vec3& inertia = setup.inertia;
  const double largest = inertia.maxCoeff();
  problems.require(is_valid(setup.T_parent_node), "pose", "", "is not a pose: expected finite numbers and a quaternion of unit length");
  problems.require(setup.omega_node_radps.allFinite(), "angular velocity", "", "expected finite numbers");
  const bool positive = inertia.allFinite() && inertia.minCoeff() > 0;
  problems.require(positive, "inertia", "", "expected three positive moments of inertia");
  problems.require(!positive || largest <= (inertia.sum() - largest) * (1 + 1e-12), "inertia", sim::text_of(largest),
                   "is more than the two other moments together, which no body has: correct the moments of inertia");
  problems.throw_if_any();
}

// Principal axes in the order of their moments, the first one's the greatest, as columns of a rotation matrix.
Mat3 ordered_axes(const Vec3& inertia) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return inertia[a] > inertia[b]; });
  Mat3 axes;
  axes.col(0) = Vec3::Unit(order[0]);
  axes.col(2) = Vec3::Unit(order[2]);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Mat3 reversed(const Mat3& axes) {
  Mat3 result;
  result << axes.col(2), -axes.col(1), axes.col(0);
  return result;
}

Mat3 about_z(double angle_rad) {
  const SinCos a = sin_cos(std::remainder(angle_rad, 2 * kPi));
  Mat3 R;
  R << a.cos, -a.sin, 0, a.sin, a.cos, 0, 0, 0, 1;
  return R;
}

}  // namespace

TorqueFree::TorqueFree(const Setup& setup, const Place& place) : setup_(setup) {
  check(setup, place);
  const Vec3 momentum = setup.inertia.cwiseProduct(setup.omega_node_radps);
  spins_ = momentum.cross(setup.omega_node_radps).norm() <= kLeastWobble * momentum.norm() * setup.omega_node_radps.norm();
  if (spins_) return;
  const Mat3 axes = ordered_axes(setup.inertia);
  const Vec3 inertia = (axes.transpose() * setup.inertia.asDiagonal() * axes).diagonal();
  const Vec3 omega2 = (axes.transpose() * setup.omega_node_radps).cwiseAbs2();
  // The sign of 2 E I2 - L^2 says about which of the outer axes the top goes round.
  const bool about_least = inertia[2] * (inertia[1] - inertia[2]) * omega2[2] > inertia[0] * (inertia[0] - inertia[1]) * omega2[0];
  solve(about_least ? axes : reversed(axes));
}

// Each quantity is a sum of terms of one sign, but for the complement m1, whose one difference is that of the given state.
void TorqueFree::solve(const Mat3& R_node_top) {
  R_node_top_ = R_node_top;
  inertia_top_ = (R_node_top.transpose() * setup_.inertia.asDiagonal() * R_node_top).diagonal();
  const double i1 = inertia_top_[0], i2 = inertia_top_[1], i3 = inertia_top_[2];
  const Vec3 omega = R_node_top.transpose() * setup_.omega_node_radps;
  const Vec3 omega2 = omega.cwiseAbs2();
  const double share_2_1 = i2 * (i2 - i3) / (i1 * (i1 - i3)), share_2_3 = i2 * (i1 - i2) / (i3 * (i1 - i3));
  const double sign = std::copysign(1, omega[2]);
  const double order = std::copysign(1, i3 - i1);
  peak_top_radps_ = Vec3(square_root(omega2[0] + share_2_1 * omega2[1]), order * sign * square_root(omega2[1] + omega2[0] / share_2_1),
                         sign * square_root(omega2[2] + share_2_3 * omega2[1]));
  const double whole = i3 * (i2 - i3) * peak_top_radps_[2] * peak_top_radps_[2];
  m1_ = clamp((i3 * (i2 - i3) * omega2[2] - i1 * (i1 - i2) * omega2[0]) / whole, kLeastComplement, 1);
  characteristic_ = -i3 * (i1 - i2) / (i1 * (i2 - i3));
  pace_ = square_root((i1 - i3) * (i2 - i3) / (i1 * i2)) * std::fabs(peak_top_radps_[2]);
  const Amplitude begin = to_amplitude(omega[1] / peak_top_radps_[1], omega[0] / peak_top_radps_[0]);
  phase_ = elliptic_first(begin, m1_);
  precession_radps_ = inertia_top_.cwiseProduct(omega).norm() / i3;
  precession_factor_ = precession_radps_ * ((i1 - i3) / i1) / pace_;
  precession_begin_ = elliptic_third(characteristic_, begin, m1_);
  R_node_momentum_ = R_node_top_ * momentum_axes(omega);
}

Vec3 TorqueFree::omega_top_radps(const Amplitude& amplitude) const {
  const SinCos a = whole_angle(amplitude);
  const double delta = square_root(m1_ + (1 - m1_) * a.cos * a.cos);
  return peak_top_radps_.cwiseProduct(Vec3(a.cos, a.sin, delta));
}

// Columns, in the top's axes: the line of nodes (angular momentum x axis 3), its normal, and the angular momentum's direction.
Mat3 TorqueFree::momentum_axes(const Vec3& omega_top) const {
  const Vec3 momentum = inertia_top_.cwiseProduct(omega_top);
  Mat3 axes;
  axes.col(2) = momentum / square_root(momentum.squaredNorm());
  axes.col(0) = Vec3(momentum.y(), -momentum.x(), 0) / square_root(momentum.head<2>().squaredNorm());
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// The axes of the angular momentum turn about it by the angle of precession, and the top in them as its angular velocity says.
MotionState TorqueFree::at(TimeUs t_us) const {
  const double t_s = to_seconds(t_us);
  const Pose& begin = setup_.T_parent_node;
  Quat turn = exp_so3(setup_.omega_node_radps * t_s);
  Vec3 omega_node = setup_.omega_node_radps;
  if (!spins_) {
    const Amplitude amplitude = jacobi_amplitude(pace_ * t_s + phase_, m1_);
    const Vec3 omega_top = omega_top_radps(amplitude);
    const double precession_rad =
        precession_radps_ * t_s - precession_factor_ * (elliptic_third(characteristic_, amplitude, m1_) - precession_begin_);
    const Mat3 R_momentum_node = momentum_axes(omega_top).transpose() * R_node_top_.transpose();
    turn = to_quaternion(R_node_momentum_ * about_z(precession_rad) * R_momentum_node);
    omega_node = R_node_top_ * omega_top;
  }
  MotionState state;
  state.T_a_b = Pose{normalized(begin.q * turn), begin.p};
  state.rates.omega_radps = rotate(state.T_a_b.q, omega_node);
  return state;
}

}  // namespace lasso::mdat::scene
