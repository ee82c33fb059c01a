// Stands of a turntable: what several scans of a target at rest say of its pose, and two stands of the turn between them.
#pragma once

#include <span>

#include "fsw/geometry/se3.hpp"

namespace lasso::mdat {

// The mean of a stand's estimates, and how far single ones are from it.
struct StandMean {
  Pose pose;                // T_sensor_target; the attitude is the mean on the rotation group
  double z_std_m = 0;       // along the boresight; of the whole population (division by n)
  double turn_std_rad = 0;  // about the target's x axis
};
StandMean mean_of_stand(std::span<const Pose> estimates);  // at least one

// The angle about its own x axis by which a target of attitude `to` is turned against `from`, -pi to pi: the twist of the swing and twist
// of from^-1 to. Both are T_sensor_target.
double turn_about_x(const Quat& from, const Quat& to);

// How far the turn between two estimates is from the commanded one, -pi to pi: no truth is needed, as in a laboratory.
double turn_error(const Quat& from, const Quat& to, double commanded_rad);

}  // namespace lasso::mdat
