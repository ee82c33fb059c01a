#include "fsw/pose/scan/path_pose.hpp"

namespace lasso {

Pose step_pose(const Pose& T_target_sensor, const Vec6& x) {
  const Vec3 half = 0.5 * x.head<3>();
  const Quat step = normalized(Quat(1.0, half[0], half[1], half[2]));
  Pose result;
  result.q = normalized(step * T_target_sensor.q);
  result.p = rotate(step, T_target_sensor.p) + x.tail<3>();
  return result;
}

Vec6 way_between(const Pose& from, const Pose& to) {
  const Quat turn = normalized(to.q * from.q.conjugate());
  Vec6 way;
  way << log_so3(turn), to.p - rotate(turn, from.p);
  return way;
}

}  // namespace lasso
