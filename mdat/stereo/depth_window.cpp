#include "mdat/stereo/depth_window.hpp"

#include <algorithm>
#include <limits>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {

MatchDepths predicted_depths(const Mesh& target, const Pose& T_sensor_target, double baseline_m) {
  double nearest_m = std::numeric_limits<double>::infinity(), farthest_m = -nearest_m;
  for (const Vec3& vertex : target.vertices) {
    const double depth_m = (T_sensor_target * vertex).z();
    nearest_m = std::min(nearest_m, depth_m);
    farthest_m = std::max(farthest_m, depth_m);
  }
  const double least_m = kNearestBaselines * baseline_m;
  const double from_m = std::max(least_m, (1 - kDepthMargin) * nearest_m);
  return {from_m, std::max(2 * from_m, (1 + kDepthMargin) * farthest_m)};
}

}  // namespace lasso::mdat
