// Where a sensor has the target's box in its field. Inside of missiondb.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "mdat/missiondb/rule.hpp"

namespace lasso::mdat {

// What a sensor at the origin sees of the box, on the tangent plane.
struct Seen {
  bool in_front = false;  // all of it
  double middle_x = 0, middle_y = 0, low_x = 1e9, low_y = 1e9, high_x = -1e9, high_y = -1e9;
};
Seen seen_of(const TargetSize& target, const Eigen::Isometry3d& T_sensor_target);

bool is_outside(const Seen& seen, const SensorParameters& sensor);  // all of it
bool is_off(const Seen& seen, const SensorParameters& sensor);      // its middle

// How far the middle is off the boresight, beside the field.
std::string sides_text(const SensorParameters& sensor, const Seen& seen);

}  // namespace lasso::mdat
