// Test targets: meshes, and the closed-form ranges to the shapes that they stand for.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "fsw/geometry/types.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

constexpr double kNoHit = std::numeric_limits<double>::infinity();

struct ShapeMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c, d});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
};

// Axis-aligned box around the origin, outward normals.
inline ShapeMesh box_mesh(const Vec3& half) {
  ShapeMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 u = Vec3::Unit((axis + 1) % 3).cwiseProduct(half);
    const Vec3 v = Vec3::Unit((axis + 2) % 3).cwiseProduct(half);
    const Vec3 w = Vec3::Unit(axis).cwiseProduct(half);
    mesh.quad(w - u - v, w + u - v, w + u + v, w - u + v);
    mesh.quad(-w - u - v, -w - u + v, -w + u + v, -w + u - v);
  }
  return mesh;
}

// Range to the box by the slab method.
inline double box_range(const Vec3& half, const Vec3& origin, const Vec3& direction) {
  double enter = 0;
  double leave = kNoHit;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-half[axis] - origin[axis]) / direction[axis];
    const double b = (half[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : kNoHit;
}

// Sphere of `rings` x 2 `rings` patches, vertices on the sphere; radius * cos(pi / (2 rings)) is within the mesh.
inline ShapeMesh sphere_mesh(double radius, int rings) {
  const double step = M_PI / rings;
  const auto at = [&](int i, int k) {  // the seam and the poles are closed to the last bit
    const double angle = (k % (2 * rings)) * step;
    const double across = i == rings ? 0 : radius * std::sin(i * step);
    return Vec3(across * std::cos(angle), across * std::sin(angle), radius * std::cos(i * step));
  };
  ShapeMesh mesh;
  for (int k = 0; k < 2 * rings; ++k) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i <= rings; ++i) mesh.vertices.insert(mesh.vertices.end(), {at(i, k), at(i, k + 1)});
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(rings); ++i) {
      const std::uint32_t a = first + 2 * i;
      if (i + 1 < static_cast<std::uint32_t>(rings)) mesh.triangles.push_back({a, a + 2, a + 3});
      if (i > 0) mesh.triangles.push_back({a, a + 3, a + 1});
    }
  }
  return mesh;
}

inline double sphere_range(double radius, const Vec3& origin, const Vec3& direction) {
  const double b = origin.dot(direction);
  const double discriminant = b * b - origin.squaredNorm() + radius * radius;
  return discriminant < 0 || b > 0 ? kNoHit : -b - std::sqrt(discriminant);
}

inline Vec3 random_unit(Generator& generator) {
  const Vec3 v(generator.normal(), generator.normal(), generator.normal());
  return v.normalized();
}

}  // namespace lasso::test
