// Where the target truly is: T_sensor_target and its rates at any time.
#pragma once

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"

namespace lasso::sim {

struct TruthState {
  Pose T_sensor_target;
  Twist rates;  // of T_sensor_target, sensor axes
};

class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual TruthState at(TimeUs t_us) const = 0;
  // The pose alone, for rays: one that costs less may stand in, by one caller at a time, where it is as good as exact.
  virtual Pose pose_at(TimeUs t_us) const { return at(t_us).T_sensor_target; }
};

// The attitude of a target whose long axis is its x axis: x points up in the image (sensor -y) and z along the boresight at zero angles;
// then its aft (-x) end is tilted towards the sensor by `tilt_rad` about the sensor's x axis, and the whole is turned by
// `boresight_turn_rad` about the boresight (right-handed about sensor z).
Quat upright_attitude(double tilt_rad, double boresight_turn_rad);

// Constant velocity of the target's origin and constant angular velocity, both in sensor axes.
class ConstantTwist final : public Trajectory {
 public:
  // `initial` holds at `epoch_us`. Throws std::invalid_argument: pose not valid, a rate not finite.
  ConstantTwist(const TruthState& initial, TimeUs epoch_us);
  TruthState at(TimeUs t_us) const override;

 private:
  TruthState initial_;
  TimeUs epoch_us_;
};

// Angular velocity in sensor axes of a target that turns by `rate_radps` about its own axis `axis_target` (unit).
Vec3 spin_in_sensor_axes(const Pose& T_sensor_target, const Vec3& axis_target, double rate_radps);

}  // namespace lasso::sim
