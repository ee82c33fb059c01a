// Convex planar polygons of three or four sides with the smooth normals of their corners: what becomes the elements.
#pragma once

#include "mdat/modelc/topology.hpp"

namespace lasso::mdat {

struct Polygon {
  int sides = 3;
  std::array<Vec3d, 4> corners;         // counter-clockwise seen from outside
  std::array<Vec3d, 4> corner_normals;  // unit
  Vec3d normal;                         // unit, of the plane
  bool two_sided = false;
};

struct Polygons {
  std::vector<Polygon> list;
  std::vector<std::uint32_t> of_triangle;  // slivers: their host's, or kNone
};

// Per triangle and corner: the average, weighted by the corner's angle, of the normals of the faces at that vertex that differ from this
// face's normal by less than the crease angle. Slivers do not count.
std::vector<std::array<Vec3d, 3>> smooth_normals(const Surface& surface, double crease_angle_rad);

// Joins pairs of triangles across their common edge, longest first, where the four corners lie in one plane (within 3e-7 of the extent)
// and form a convex outline.
Polygons make_polygons(const Surface& surface, const std::vector<EdgeUse>& uses, const std::vector<std::array<Vec3d, 3>>& normals);

}  // namespace lasso::mdat
