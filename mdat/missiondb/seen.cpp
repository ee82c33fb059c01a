#include "mdat/missiondb/seen.hpp"

#include <algorithm>
#include <cmath>

namespace lasso::mdat {

Seen seen_of(const TargetSize& target, const Eigen::Isometry3d& T_sensor_target) {
  Seen seen;
  const Eigen::Vector3d middle = T_sensor_target * target.middle();
  seen.in_front = middle.z() > 0;
  seen.middle_x = middle.x() / middle.z();
  seen.middle_y = middle.y() / middle.z();
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? target.high.x() : target.low.x(), (i & 2) != 0 ? target.high.y() : target.low.y(),
                                 (i & 4) != 0 ? target.high.z() : target.low.z());
    const Eigen::Vector3d p = T_sensor_target * corner;
    seen.in_front = seen.in_front && p.z() > 0;
    seen.low_x = std::min(seen.low_x, p.x() / p.z());
    seen.high_x = std::max(seen.high_x, p.x() / p.z());
    seen.low_y = std::min(seen.low_y, p.y() / p.z());
    seen.high_y = std::max(seen.high_y, p.y() / p.z());
  }
  return seen;
}

bool is_outside(const Seen& seen, const SensorParameters& sensor) {
  const double x = std::tan(sensor.fov_half_x_rad), y = std::tan(sensor.fov_half_y_rad);
  return seen.low_x > x || seen.high_x < -x || seen.low_y > y || seen.high_y < -y;
}

bool is_off(const Seen& seen, const SensorParameters& sensor) {
  return std::fabs(seen.middle_x) > std::tan(sensor.fov_half_x_rad) || std::fabs(seen.middle_y) > std::tan(sensor.fov_half_y_rad);
}

std::string sides_text(const SensorParameters& sensor, const Seen& seen) {
  return "its middle is " + degrees_text(std::atan(std::hypot(seen.middle_x, seen.middle_y))) +
         " off the boresight, and the half field is " + degrees_text(sensor.fov_half_x_rad) + " by " + degrees_text(sensor.fov_half_y_rad);
}

}  // namespace lasso::mdat
