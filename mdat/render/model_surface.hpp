// The target as a renderer needs it: what a ray meets, which part it is of, and how the surface stands there.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// A place on the surface, target frame.
struct SurfacePoint {
  Vec3 place_m = Vec3::Zero();
  Vec3 facet_normal = Vec3::UnitZ();   // unit, of the triangle, towards where the ray came from
  Vec3 smooth_normal = Vec3::UnitZ();  // unit, between the triangle's corners; on the same side
  double range_m = 0;
  std::uint32_t part = 0;
};

class ModelSurface {
 public:
  // `part_of_triangle`: one for each triangle. Facets of one part that meet at less than `crease_angle_rad` are one smooth surface: the
  // normal at a corner is the mean of those around, weighted by their angles there (Thürmer, Wüthrich 1998). Triangles without area are
  // left out. Throws std::invalid_argument as make_ray_caster.
  ModelSurface(const Mesh& mesh, const std::vector<std::uint32_t>& part_of_triangle, double crease_angle_rad);

  // What a ray of unit direction meets first; false: nothing.
  bool find(const Vec3& origin_m, const Vec3& direction, SurfacePoint& point) const;
  bool is_blocked(const Vec3& origin_m, const Vec3& direction) const { return caster_->is_blocked(origin_m, direction); }
  double extent_m() const { return extent_m_; }  // largest side of the box about it

 private:
  Vec3 smooth_normal(std::uint32_t triangle, const Vec3& place_m) const;
  void smooth_corners(double crease_angle_rad);

  Mesh mesh_;
  std::vector<std::uint32_t> parts_;
  std::vector<Vec3> facet_normals_, corner_normals_;  // one, and three, for each triangle
  std::unique_ptr<sim::RayCaster> caster_;
  double extent_m_ = 0;
};

}  // namespace lasso::mdat
