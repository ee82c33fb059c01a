// Before a head: a small square at 2 m in front of a large one at 4 m, on the axis of the left camera.
#pragma once

#include "mdat/stereo/stereo_head.hpp"
#include "ut/mdat/render/shapes.hpp"

namespace lasso::mdat {

inline StereoHead small_head() {
  StereoSource source;
  source.pixels = 200;
  source.baseline_m = 0.2;
  source.exposure_s = 1e-4;
  return make_head(source, 0.4, 0.4);
}

inline Mesh two_squares(double near_m, double near_side_m, double far_m, double far_side_m) {
  Mesh all = square(far_side_m), small = square(near_side_m);
  for (Vec3& vertex : all.vertices) vertex.z() = far_m;
  const auto offset = static_cast<std::uint32_t>(all.vertices.size());
  for (const Vec3& vertex : small.vertices) all.vertices.push_back({vertex.x(), vertex.y(), near_m});
  for (const auto& triangle : small.triangles) all.triangles.push_back({triangle[0] + offset, triangle[1] + offset, triangle[2] + offset});
  return all;
}

// From behind the cameras.
inline Lights sun_behind() {
  Lights lights;
  lights.sun = -Vec3::UnitZ();
  return lights;
}

}  // namespace lasso::mdat
