// Pictures of a target that are not yet shown: radiance, and what the middle of each pixel sees.
#pragma once

#include <functional>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "mdat/render/camera.hpp"
#include "mdat/render/shading.hpp"

namespace lasso::mdat {

struct SeenPoint {
  bool hit = false;
  double depth_m = 0;          // along the boresight
  double range_m = 0;          // along the ray
  Vec3 normal = Vec3::Zero();  // unit, smooth, sensor frame, towards the camera
  std::uint32_t part = 0;
};

struct RenderSetup {
  Camera camera;
  Pose T_sensor_target;
  int samples_per_axis = 3;  // n x n rays a pixel
  unsigned jobs = 1;         // rows at a time; the result does not depend on it
  // Called now and then on the caller's thread with the number of finished rows; may be empty.
  std::function<void(std::size_t)> progress;
};

// What the middle of each pixel sees, row by row from the top.
std::vector<SeenPoint> seen_points(const ModelSurface& surface, const RenderSetup& setup);

// Mean radiance of each pixel, W/m2/sr, row by row from the top. Directions of `lights` are in the sensor frame. `materials`: one for each
// part.
std::vector<Rgb> rendered(const ModelSurface& surface, const std::vector<Material>& materials, const Lights& lights,
                          const RenderSetup& setup);

}  // namespace lasso::mdat
