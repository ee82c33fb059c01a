// The rows of commands, in the order of the wire. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/row.hpp"

namespace lasso::command_rows {

// clang-format off
inline constexpr TypedRow<ModeCommand> kMode[] = {
  make_row<&ModeCommand::mode>(1, "mode", kTrackingMode, "standby, bearing, reacquiring or searching"),
};
inline constexpr TypedRow<HoldCommand> kHold[] = {
  make_row<&HoldCommand::held>(1, "held", kYesNo, "no mode ends because its frames are used up, and no start is taken but by command"),
};
inline constexpr TypedRow<StartCommand> kStart[] = {
  make_row<&StartCommand::way>(1, "way", kStartWay, "by which the pose comes: handover or uplink start at once, navigation waits for its turn"),
  make_row<&StartCommand::t_us>(2, "t_us", "us", kAny, "time at which pose and rates are stated"),
  make_row<&StartCommand::q_sensor_target>(3, "q_sensor_target", "1", kAny, "Hamilton quaternion x, y, z, w of unit length, target to sensor"),
  make_row<&StartCommand::p_sensor_target_m>(4, "p_sensor_target_m", "m", kAny, "target's origin in the sensor frame"),
  make_row<&StartCommand::omega_radps>(5, "omega_radps", "rad/s", kAny, "angular rate, sensor axes"),
  make_row<&StartCommand::v_mps>(6, "v_mps", "m/s", kAny, "velocity of the target's origin, sensor axes"),
  make_row<&StartCommand::covariance>(7, "covariance", "rad,m", kAny, "upper triangle by rows: rotation about target origin, translation; sensor axes"),
};
// clang-format on

}  // namespace lasso::command_rows
