// Frames that a mission names besides the sensor's and the target's: a docking port on the chaser, a grapple point on the target.
#pragma once

#include "fsw/geometry/se3.hpp"

namespace lasso {

// What the component reports the pose of, and in which frame: both are known without error, one on the target, one on what carries the
// sensors.
struct NamedFrame {
  Pose T_target_of;
  Pose T_in_sensor;
};

inline bool is_valid(const NamedFrame& frame) { return is_valid(frame.T_target_of) && is_valid(frame.T_in_sensor); }

}  // namespace lasso
