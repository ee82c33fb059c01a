// Where the target truly is: T_sensor_target and its rates at any time.
#pragma once

#include <memory>
#include <vector>

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

// The simulation of the paper: the target stands still during each frame; in frame k it is turned by k * step about an axis of its own.
class SteppedSpin final : public Trajectory {
 public:
  struct Setup {
    Pose T_sensor_target_frame0;
    Vec3 axis_target = Vec3::UnitX();  // unit, target axes, through the target's origin
    double step_rad = 0;               // per frame
    TimeUs epoch_us = 0;               // begin of frame 0
    DurationUs period_us = 200000;     // of a frame, > 0
  };
  // Throws std::invalid_argument: pose not valid, axis not of unit length within 1e-6, step not finite, period not positive.
  explicit SteppedSpin(const Setup& setup);

  // Rates are zero: the steps happen between the frames. Frames before the epoch count down from -1.
  TruthState at(TimeUs t_us) const override;
  TruthState at_frame(std::int64_t frame) const;
  std::int64_t frame_of(TimeUs t_us) const;
  TimeUs frame_begin_us(std::int64_t frame) const { return setup_.epoch_us + frame * setup_.period_us; }

 private:
  Setup setup_;
};

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

// An approach: the target's origin moves along the boresight, through given ranges at given times, at rest at each of them and smoothly
// (cubic) between; before the first and after the last it stays. The attitude turns at a constant rate from the epoch on.
class RangeProfile final : public Trajectory {
 public:
  struct Setup {
    Pose T_sensor_target_at_epoch;  // its z is not used
    Vec3 omega_radps = Vec3::Zero();
    std::vector<double> times_s;   // since the epoch, ascending
    std::vector<double> ranges_m;  // one for each time
    TimeUs epoch_us = 0;
  };
  // Throws std::invalid_argument: pose not valid, a rate, time or range not finite, no time, as many ranges as times not given, or times
  // that do not ascend.
  explicit RangeProfile(Setup setup);
  TruthState at(TimeUs t_us) const override;

 private:
  Setup setup_;
};

// The motion of a frame with the target's axes whose origin is another point of the target: ranges are that point's, and the target turns
// about it.
class AboutPoint final : public Trajectory {
 public:
  // `point_m` in the target's frame. Throws std::invalid_argument: no motion, or the point is not finite.
  AboutPoint(std::unique_ptr<Trajectory> motion, const Vec3& point_m);
  TruthState at(TimeUs t_us) const override;

 private:
  std::unique_ptr<Trajectory> motion_;
  Vec3 point_m_;
};

// Angular velocity in sensor axes of a target that turns by `rate_radps` about its own axis `axis_target` (unit).
Vec3 spin_in_sensor_axes(const Pose& T_sensor_target, const Vec3& axis_target, double rate_radps);

}  // namespace lasso::sim
