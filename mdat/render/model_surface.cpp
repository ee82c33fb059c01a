#include "mdat/render/model_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Vec3 twice_the_area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

double angle_at(const Corners& c, std::size_t corner) {
  const Vec3 a = c[(corner + 1) % 3] - c[corner], b = c[(corner + 2) % 3] - c[corner];
  return arc_tangent2(a.cross(b).norm(), a.dot(b));
}

Vec3 moved(const Pose& T_a_b, const Vec3& v) { return rotate(T_a_b.q, v) + T_a_b.p; }

using Triangle = std::array<std::uint32_t, 3>;

// Of the vertices that the triangles have.
std::unique_ptr<sim::RayCaster> caster_of(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::vector<Vec3> used;
  std::vector<Triangle> renumbered = triangles;
  for (Triangle& triangle : renumbered) {
    for (std::uint32_t& vertex : triangle) {
      const auto [number, is_new] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(used.size()));
      if (is_new) used.push_back(vertices[vertex]);
      vertex = number->second;
    }
  }
  return sim::make_ray_caster(used, renumbered);
}

double extent_of(const Mesh& mesh) {
  Vec3 low = mesh.vertices.at(0), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

// A vertex is known by its place: many files write it once for each of its triangles.
using Place = std::array<double, 4>;
Place place_of(std::uint32_t part, const Vec3& v) { return {static_cast<double>(part), v.x(), v.y(), v.z()}; }

}  // namespace

ModelSurface::ModelSurface(const Mesh& mesh, const std::vector<std::uint32_t>& part_of_triangle, double crease_angle_rad)
    : ModelSurface(std::vector<SurfaceBody>{{mesh, part_of_triangle, {}, 0}}, crease_angle_rad) {}

ModelSurface::ModelSurface(const std::vector<SurfaceBody>& bodies, double crease_angle_rad) {
  for (const SurfaceBody& body : bodies) add_body(body);
  smooth_corners(crease_angle_rad);
}

void ModelSurface::add_body(const SurfaceBody& body) {
  const auto number = static_cast<std::uint32_t>(frames_.size()), first = static_cast<std::uint32_t>(mesh_.vertices.size());
  const bool is_target = number == 0;  // whose frame is that of the picture
  const auto first_triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
  for (const Vec3& v : body.mesh.vertices) mesh_.vertices.emplace_back(is_target ? v : moved(body.T_target_body, v));
  for (std::size_t i = 0; i < body.mesh.triangles.size(); ++i) {
    const auto& t = body.mesh.triangles[i];
    mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    const Vec3 normal = twice_the_area(corners_of(mesh_, mesh_.triangles.size() - 1));
    if (normal.norm() > 0) {
      parts_.push_back(body.part_of_triangle.at(i));
      bodies_.push_back(number);
      facet_normals_.emplace_back(normal.normalized());
    } else {
      mesh_.triangles.pop_back();
    }
  }
  const std::vector<Triangle> own(mesh_.triangles.begin() + first_triangle, mesh_.triangles.end());
  frames_.push_back({body.T_target_body, body.size_m > 0 ? body.size_m : extent_of(body.mesh), first_triangle, nullptr});
  if (!own.empty() || is_target) frames_.back().caster = caster_of(mesh_.vertices, own);
}

Vec3 ModelSurface::to_body(const SurfacePoint& point) const {
  return point.body == 0 ? point.place_m : moved(inverse(frames_[point.body].T_target_body), point.place_m);
}

void ModelSurface::smooth_corners(double crease_angle_rad) {
  struct Facet {
    std::size_t triangle;
    double angle_rad;
  };
  std::map<Place, std::vector<Facet>> facets_at;
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Corners c = corners_of(mesh_, i);
    for (std::size_t k = 0; k < 3; ++k) facets_at[place_of(parts_[i], c[k])].push_back({i, angle_at(c, k)});
  }
  const double least_cosine = sin_cos(crease_angle_rad).cos;
  const auto mean_normal = [&](std::size_t triangle, const std::vector<Facet>& around) -> Vec3 {
    Vec3 sum = Vec3::Zero();
    for (const Facet& facet : around) {
      const Vec3& normal = facet_normals_[facet.triangle];
      if (normal.dot(facet_normals_[triangle]) > least_cosine) sum += facet.angle_rad * normal;
    }
    return sum.norm() > 0 ? sum.normalized() : facet_normals_[triangle];
  };
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    for (const Vec3& corner : corners_of(mesh_, i)) corner_normals_.push_back(mean_normal(i, facets_at[place_of(parts_[i], corner)]));
  }
}

// By the shares of the triangle's area that are opposite to its corners.
Vec3 ModelSurface::smooth_normal(std::uint32_t triangle, const Vec3& place_m) const {
  const Corners c = corners_of(mesh_, triangle);
  const Vec3& n = facet_normals_[triangle];
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = (c[(k + 1) % 3] - place_m).cross(c[(k + 2) % 3] - place_m).dot(n);
    sum += std::max(0.0, share) * corner_normals_[3 * std::size_t{triangle} + k];
  }
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : n;
}

bool ModelSurface::is_blocked(const Vec3& origin_m, const Vec3& direction) const {
  return std::any_of(frames_.begin(), frames_.end(),
                     [&](const Frame& frame) { return frame.caster != nullptr && frame.caster->is_blocked(origin_m, direction); });
}

bool ModelSurface::is_blocked(const Vec3& origin_m, const Vec3& direction, double within_m) const {
  return std::any_of(frames_.begin(), frames_.end(), [&](const Frame& frame) {
    if (frame.caster == nullptr) return false;
    const sim::RayHit hit = frame.caster->cast(origin_m, direction);
    return hit.hit && hit.range_m < within_m;
  });
}

bool ModelSurface::find(const Vec3& origin_m, const Vec3& direction, SurfacePoint& point) const {
  sim::RayHit hit;
  for (const Frame& frame : frames_) {
    if (frame.caster == nullptr) continue;
    sim::RayHit of_body = frame.caster->cast(origin_m, direction);
    if (!of_body.hit || (hit.hit && of_body.range_m >= hit.range_m)) continue;
    of_body.triangle += frame.first_triangle;
    hit = of_body;
  }
  if (!hit.hit) return false;
  point.place_m = origin_m + hit.range_m * direction;
  point.range_m = hit.range_m;
  point.part = parts_[hit.triangle];
  point.body = bodies_[hit.triangle];
  const double side = hit.normal.dot(direction) > 0 ? -1 : 1;
  point.facet_normal = side * hit.normal;
  point.smooth_normal = side * smooth_normal(hit.triangle, point.place_m);
  return true;
}

}  // namespace lasso::mdat
