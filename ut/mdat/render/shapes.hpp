// Bodies whose pictures are known.
#pragma once

#include "fsw/geometry/so3.hpp"
#include "mdat/missiondb/solid.hpp"
#include "mdat/render/render.hpp"

namespace lasso::mdat {

// A square in the plane z = 0 about the origin.
inline Mesh square(double side_m) {
  const double a = side_m / 2;
  return {{{-a, -a, 0}, {a, -a, 0}, {a, a, 0}, {-a, a, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

inline Mesh ball(double radius_m, int fineness) {
  RockShape shape;
  shape.size = Eigen::Vector3d::Constant(2 * radius_m);
  shape.fineness = fineness;
  return make_rock(shape);
}

inline ModelSurface surface_of(const Mesh& mesh, double crease_rad = 0.5) {
  return {mesh, std::vector<std::uint32_t>(mesh.triangles.size(), 0), crease_rad};
}

inline Material matt(double diffuse) { return {"matt", "", {Rgb::Constant(diffuse), Rgb::Zero(), 1}, 0, 0, 0, 0, 1 - diffuse}; }

// No rotation about an axis of any frame.
inline Quat generic_attitude() { return exp_so3(Vec3(0.7, -0.4, 1.1)); }

}  // namespace lasso::mdat
