// What a ray meets first on a triangle mesh. All in the mesh's own frame, metres. The library behind it stays behind it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "fsw/geometry/types.hpp"
#include "hal_sim/laser_reflection.hpp"

namespace lasso::sim {

struct RayHit {
  bool hit = false;
  double range_m = 0;                           // along the unit direction, computed in double from the plane of the triangle
  std::uint32_t triangle = 0;                   // index into the mesh
  Vec3 normal = Vec3::Zero();                   // unit, by the triangle's winding (it may point away from the ray's origin)
  const LaserReflection* reflection = nullptr;  // of that triangle, as long as the caster lives; none: nobody says
};

class RayCaster {
 public:
  virtual ~RayCaster() = default;
  // `direction` of unit length. Both sides of a triangle are hit; what lies at or behind the origin is not. Safe from several threads.
  virtual RayHit cast(const Vec3& origin_m, const Vec3& direction) const = 0;
  // Whether it meets anything, at any range: the answer of cast, sooner.
  virtual bool is_blocked(const Vec3& origin_m, const Vec3& direction) const { return cast(origin_m, direction).hit; }
};

// A caster over copies of the vertices and triangles (counter-clockwise seen from outside), built with Embree in its robust mode: a ray
// through a shared edge or vertex does not slip between the triangles. Which triangle is hit is decided in single precision near the mesh,
// the range in double. Restricted to one instruction set so that every x86-64 machine takes the same decisions.
// `reflections`: one for each triangle, or none.
// Throws std::invalid_argument: no triangle, an index outside the vertices, a vertex that is not finite, a triangle without area, another
// number of reflections.
std::unique_ptr<RayCaster> make_ray_caster(std::span<const Vec3> vertices_m, std::span<const std::array<std::uint32_t, 3>> triangles,
                                           std::span<const LaserReflection> reflections = {});

}  // namespace lasso::sim
