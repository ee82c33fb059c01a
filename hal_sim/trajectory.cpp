#include "hal_sim/trajectory.hpp"

#include <cmath>
#include <stdexcept>

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

ConstantTwist::ConstantTwist(const TruthState& initial, TimeUs epoch_us) : initial_(initial), epoch_us_(epoch_us) {
  require(is_valid(initial.T_sensor_target), "constant twist: the initial pose is not valid");
  require(initial.rates.omega_radps.allFinite() && initial.rates.v_mps.allFinite(), "constant twist: a rate is not finite");
}

TruthState ConstantTwist::at(TimeUs t_us) const {
  return {propagate(initial_.T_sensor_target, initial_.rates, to_seconds(t_us - epoch_us_)), initial_.rates};
}

Vec3 spin_in_sensor_axes(const Pose& T_sensor_target, const Vec3& axis_target, double rate_radps) {
  return rotate(T_sensor_target.q, axis_target) * rate_radps;
}

}  // namespace lasso::sim
