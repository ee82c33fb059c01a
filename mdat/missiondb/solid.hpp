// Primitive solids as closed triangle meshes, oriented outwards. Lengths in any one unit, angles in radians.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// Six faces, centred on the origin.
Mesh make_box(const Eigen::Vector3d& size);

// The closed polygon `profile` of points (x, r), r >= 0, turned about the x axis from `start` (0 at +y, growing towards +z) over `sweep`
// (2 pi: all around) in `sides` steps. Neither the profile nor the solid may cross itself. Less than a full turn is closed by caps.
struct Turn {
  double start_rad = 0;
  double sweep_rad = 0;
  int sides = 0;
};
Mesh make_revolve(const std::vector<Eigen::Vector2d>& profile, const Turn& turn);

// A cylinder or cone from `from` to `to`; a radius of 0 is a tip.
Mesh make_rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_from, double radius_to, int sides);

// A paraboloid shell that opens towards +x: inner apex at the origin, rim at x = depth and r = radius; `thickness` along x, behind.
struct DishShape {
  double radius = 0, depth = 0, thickness = 0;
  int rings = 0, sides = 0;
};
Mesh make_dish(const DishShape& shape);

// An ellipsoid of the sides `size` with bumps and hollows, as asteroids have: an icosphere, divided `fineness` times, whose radii change by
// smooth functions of the direction that `seed` draws. A radius changes by `roughness` of it at most, so that the surface stays star-shaped
// about the origin. `size` is the ellipsoid's: the rock may reach farther, by `roughness`.
struct RockShape {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  double roughness = 0;  // 0 to 0.5
  std::uint64_t seed = 0;
  int fineness = 3;  // 20 triangles times 4 to this power
};
Mesh make_rock(const RockShape& shape);

// Triangles of a simple polygon (it need not be convex), each counter-clockwise, as indices of `points`; bounded by their number cubed.
// Where given, `tests` grows by the work that was done.
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(const std::vector<Eigen::Vector2d>& points, std::size_t* tests = nullptr);

// Positive where the surface is closed and oriented outwards.
double signed_volume(const Mesh& mesh);

void append(Mesh& mesh, const Mesh& part);

}  // namespace lasso::mdat
