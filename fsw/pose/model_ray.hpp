// A ray of the scan against the model as a whole.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/clip.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

// What the ray meets of the model in front of the sensor; t is its range. `pose` is T_target_sensor. Bounded by walk_field.
inline FieldHit<FlightNumber> meet_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray) {
  FieldRay<FlightNumber> r{};
  transform(pose, ray.o, r.m);
  rotate(pose, ray.u, r.u);
  return cast_ray(mission.field, r);
}

inline bool meets_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray) {
  return meet_model(mission, pose, ray).found;
}

}  // namespace lasso
