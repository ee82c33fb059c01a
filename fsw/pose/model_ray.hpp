// A ray of the scan against the model as a whole.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/clip.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

// Does the ray meet the model anywhere in front of the sensor? `pose` is T_target_sensor. Bounded by walk_field.
inline bool meets_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray) {
  FieldRay<FlightNumber> r{};
  transform(pose, ray.o, r.m);
  rotate(pose, ray.u, r.u);
  return cast_ray(mission.field, r).found;
}

}  // namespace lasso
