// The target as a renderer needs it: what a ray meets, which part it is of, and how the surface stands there.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/geometry/so3.hpp"
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
  std::uint32_t body = 0;
};

// A body among those that a picture shows. Relief and shades stay on it as it moves, and grow with its size.
struct SurfaceBody {
  Mesh mesh;                                    // in its own frame
  std::vector<std::uint32_t> part_of_triangle;  // one for each triangle; bodies that share a part have it in common
  Pose T_target_body;
  double size_m = 0;  // largest side of the box about what it is of; 0: about the mesh
};

class ModelSurface {
 public:
  // `part_of_triangle`: one for each triangle. Facets of one part that meet at less than `crease_angle_rad` are one smooth surface: the
  // normal at a corner is the mean of those around, weighted by their angles there (Thürmer, Wüthrich 1998). Triangles without area are
  // left out. Throws std::invalid_argument as make_ray_caster.
  ModelSurface(const Mesh& mesh, const std::vector<std::uint32_t>& part_of_triangle, double crease_angle_rad);
  // The same of several bodies, the target first.
  ModelSurface(const std::vector<SurfaceBody>& bodies, double crease_angle_rad);

  // What a ray of unit direction meets first; false: nothing.
  bool find(const Vec3& origin_m, const Vec3& direction, SurfacePoint& point) const;
  bool is_blocked(const Vec3& origin_m, const Vec3& direction) const;
  bool is_blocked(const Vec3& origin_m, const Vec3& direction, double within_m) const;  // nearer than that
  double extent_m(std::uint32_t body = 0) const { return frames_[body].extent_m; }      // SurfaceBody::size_m
  Vec3 to_body(const SurfacePoint& point) const;                                        // its place in its body's frame
  Vec3 turned_to_body(std::uint32_t body, const Vec3& v) const { return rotate(frames_[body].T_target_body.q.conjugate(), v); }
  Vec3 turned_to_target(std::uint32_t body, const Vec3& v) const { return rotate(frames_[body].T_target_body.q, v); }

 private:
  Vec3 smooth_normal(std::uint32_t triangle, const Vec3& place_m) const;
  void smooth_corners(double crease_angle_rad);

  struct Frame {
    Pose T_target_body;
    double extent_m;
    std::uint32_t first_triangle;
    std::unique_ptr<sim::RayCaster>
        caster;  // its own: one of all would be as coarse near the target as the farthest body asks; none: no area
  };
  void add_body(const SurfaceBody& body);

  Mesh mesh_;
  std::vector<Frame> frames_;  // of the bodies
  std::vector<std::uint32_t> parts_, bodies_;
  std::vector<Vec3> facet_normals_, corner_normals_;  // one, and three, for each triangle
};

}  // namespace lasso::mdat
