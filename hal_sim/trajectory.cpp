#include "hal_sim/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::sim {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

Quat upright_attitude(double tilt_rad, double boresight_turn_rad) {
  const Quat x_up = exp_so3(Vec3(0, 0, -kPi / 2));   // target x to sensor -y, target y to sensor x
  const Quat tilt = exp_so3(Vec3(-tilt_rad, 0, 0));  // sensor +y (the aft end) moves towards -z (the sensor)
  const Quat turn = exp_so3(Vec3(0, 0, boresight_turn_rad));
  return normalized(turn * (tilt * x_up));
}

SteppedSpin::SteppedSpin(const Setup& setup) : setup_(setup) {
  require(is_valid(setup.T_sensor_target_frame0), "stepped spin: the initial pose is not valid");
  require(std::abs(setup.axis_target.norm() - 1) <= 1e-6, "stepped spin: the axis is not of unit length");
  require(std::isfinite(setup.step_rad), "stepped spin: the step is not finite");
  require(setup.period_us > 0, "stepped spin: the period is not positive");
}

std::int64_t SteppedSpin::frame_of(TimeUs t_us) const {
  const DurationUs since_us = t_us - setup_.epoch_us;
  const std::int64_t frame = since_us / setup_.period_us;
  return since_us % setup_.period_us < 0 ? frame - 1 : frame;
}

TruthState SteppedSpin::at(TimeUs t_us) const { return at_frame(frame_of(t_us)); }

TruthState SteppedSpin::at_frame(std::int64_t frame) const {
  const Pose& base = setup_.T_sensor_target_frame0;
  const Quat turn = exp_so3(setup_.axis_target * (setup_.step_rad * static_cast<double>(frame)));
  return {Pose{normalized(base.q * turn), base.p}, Twist{}};
}

ConstantTwist::ConstantTwist(const TruthState& initial, TimeUs epoch_us) : initial_(initial), epoch_us_(epoch_us) {
  require(is_valid(initial.T_sensor_target), "constant twist: the initial pose is not valid");
  require(initial.rates.omega_radps.allFinite() && initial.rates.v_mps.allFinite(), "constant twist: a rate is not finite");
}

TruthState ConstantTwist::at(TimeUs t_us) const {
  return {propagate(initial_.T_sensor_target, initial_.rates, to_seconds(t_us - epoch_us_)), initial_.rates};
}

RangeProfile::RangeProfile(Setup setup) : setup_(std::move(setup)) {
  const auto finite = [](double value) { return std::isfinite(value); };
  const std::vector<double>& times = setup_.times_s;
  require(is_valid(setup_.T_sensor_target_at_epoch), "range profile: the pose is not valid");
  require(setup_.omega_radps.allFinite(), "range profile: a rate is not finite");
  require(!times.empty() && times.size() == setup_.ranges_m.size(), "range profile: expected a range for each time, and at least one");
  require(std::all_of(times.begin(), times.end(), finite), "range profile: a time is not finite");
  require(std::all_of(setup_.ranges_m.begin(), setup_.ranges_m.end(), finite), "range profile: a range is not finite");
  require(std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end(), "range profile: the times do not ascend");
}

TruthState RangeProfile::at(TimeUs t_us) const {
  const double t_s = to_seconds(t_us - setup_.epoch_us);
  const Twist turn{setup_.omega_radps, Vec3::Zero()};
  TruthState truth{propagate(setup_.T_sensor_target_at_epoch, turn, t_s), turn};
  const std::vector<double>& times = setup_.times_s;
  const std::vector<double>& ranges = setup_.ranges_m;
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t_s) - times.begin());
  if (after == 0 || after == times.size()) {
    truth.T_sensor_target.p.z() = after == 0 ? ranges.front() : ranges.back();
    return truth;
  }
  const double span_s = times[after] - times[after - 1];
  const double way_m = ranges[after] - ranges[after - 1];
  const double u = (t_s - times[after - 1]) / span_s;
  truth.T_sensor_target.p.z() = ranges[after - 1] + way_m * u * u * (3 - 2 * u);
  truth.rates.v_mps.z() = 6 * way_m / span_s * u * (1 - u);
  return truth;
}

AboutPoint::AboutPoint(std::unique_ptr<Trajectory> motion, const Vec3& point_m) : motion_(std::move(motion)), point_m_(point_m) {
  require(motion_ != nullptr, "about a point: there is no motion");
  require(point_m.allFinite(), "about a point: the point is not finite");
}

TruthState AboutPoint::at(TimeUs t_us) const {
  TruthState truth = motion_->at(t_us);
  const Vec3 to_origin_m = rotate(truth.T_sensor_target.q, Vec3(-point_m_));
  truth.T_sensor_target.p += to_origin_m;
  truth.rates.v_mps += truth.rates.omega_radps.cross(to_origin_m);
  return truth;
}

Vec3 spin_in_sensor_axes(const Pose& T_sensor_target, const Vec3& axis_target, double rate_radps) {
  return rotate(T_sensor_target.q, axis_target) * rate_radps;
}

}  // namespace lasso::sim
