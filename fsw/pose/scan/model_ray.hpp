// A ray of the scan against the model as a whole.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

// What the ray meets of the model in front of the sensor; t is its range. `pose` is T_target_sensor. Bounded by walk_field.
FieldHit<FlightNumber> meet_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray);
inline bool meets_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray) {
  return meet_model(mission, pose, ray).found;
}

}  // namespace lasso
