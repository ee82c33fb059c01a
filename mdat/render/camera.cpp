#include "mdat/render/camera.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {

Camera camera_of(PictureSize size, double fov_half_x_rad, double fov_half_y_rad) {
  Camera camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.focal_px = std::min(size.width / (2 * tangent(fov_half_x_rad)), size.height / (2 * tangent(fov_half_y_rad)));
  camera.center_x = 0.5 * (size.width - 1);
  camera.center_y = 0.5 * (size.height - 1);
  return camera;
}

PictureSize size_of(int longest, double fov_half_x_rad, double fov_half_y_rad) {
  const double shape = tangent(fov_half_x_rad) / tangent(fov_half_y_rad);
  const auto shorter = [&](double share) { return std::max(1, static_cast<int>(std::lround(longest * share))); };
  return shape >= 1 ? PictureSize{longest, shorter(1 / shape)} : PictureSize{shorter(shape), longest};
}

}  // namespace lasso::mdat
