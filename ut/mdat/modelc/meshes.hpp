// Meshes of known shape, built vertex by vertex.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "mdat/modelc/mesh.hpp"
#include "mdat/modelc/random.hpp"

namespace lasso::mdat::shapes {

using Vec3d = Eigen::Vector3d;

inline std::uint32_t u32(std::size_t n) { return static_cast<std::uint32_t>(n); }

inline void append(Mesh& mesh, const Mesh& other) {
  const std::uint32_t first = u32(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

inline void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

inline void move(Mesh& mesh, const Eigen::Quaterniond& turn, const Vec3d& shift) {
  for (Vec3d& v : mesh.vertices) v = turn * v + shift;
}

// A generic attitude, so that nothing is aligned with the grid.
inline Eigen::Quaterniond generic_turn() { return Eigen::Quaterniond(0.82, 0.31, -0.27, 0.39).normalized(); }

// Axis-aligned, outward windings, 12 triangles.
inline Mesh box(const Vec3d& low, const Vec3d& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(), (i & 4) != 0 ? high.z() : low.z());
  }
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  return mesh;
}

inline Mesh sphere(double radius, std::uint32_t rings, std::uint32_t sectors) {
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, radius);
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const double angle = 2 * std::numbers::pi * k / sectors;
      mesh.vertices.push_back(radius * Vec3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)));
    }
  }
  mesh.vertices.emplace_back(0, 0, -radius);
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * sectors + k % sectors; };
  const std::uint32_t south = u32(mesh.vertices.size()) - 1;
  for (std::uint32_t k = 0; k < sectors; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    mesh.triangles.push_back({south, at(rings - 1, k + 1), at(rings - 1, k)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) add_quad(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  return mesh;
}

// About z from z = 0 to `length`; with or without end caps.
inline Mesh cylinder(double radius, double length, std::uint32_t sectors, bool bottom = true, bool top = true) {
  Mesh mesh;
  for (std::uint32_t k = 0; k < sectors; ++k) {
    const double angle = 2 * std::numbers::pi * k / sectors;
    for (const double z : {0.0, length}) mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, length);
  for (std::uint32_t k = 0; k < sectors; ++k) {
    const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sectors);
    add_quad(mesh, a, b, b + 1, a + 1);
    if (bottom) mesh.triangles.push_back({2 * sectors, b, a});
    if (top) mesh.triangles.push_back({2 * sectors + 1, a + 1, b + 1});
  }
  return mesh;
}

// n x n squares in the plane z = 0, facing +z.
inline Mesh sheet(double size, std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) mesh.vertices.emplace_back(size * x / n, size * y / n, 0);
  }
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return y * (n + 1) + x; };
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) add_quad(mesh, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
  }
  return mesh;
}

inline Vec3d random_vector(Random& random) {
  const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1, z = 2 * random.uniform() - 1;
  return {x, y, z};
}

inline Vec3d random_unit(Random& random) {
  for (;;) {
    const Vec3d v = random_vector(random);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

// Triangles anywhere in a box of the given size, with sides up to half of it.
inline Mesh soup(std::size_t count, double size, std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d center = size / 2 * random_vector(random);
    const double reach = size / 4 * random.uniform();
    const std::uint32_t first = u32(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(center + reach * random_vector(random));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Every triangle with vertices of its own, as STL files have them.
inline Mesh unwelded(const Mesh& mesh) {
  Mesh result;
  for (const auto& t : mesh.triangles) {
    const std::uint32_t first = u32(result.vertices.size());
    for (const std::uint32_t v : t) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

// The shapes of the property tests, by name, in a generic attitude.
inline std::vector<std::pair<std::string, Mesh>> property_meshes() {
  std::vector<std::pair<std::string, Mesh>> all;
  all.emplace_back("box", box({-0.2, -0.1, -0.15}, {0.3, 0.2, 0.1}));
  all.emplace_back("sphere", sphere(0.4, 14, 20));
  all.emplace_back("plate of 1 mm", box({0, 0, 0}, {0.5, 0.3, 0.001}));
  Mesh both = cylinder(0.1, 0.5, 24);
  shapes::append(both, box({-0.05, -0.3, 0.1}, {0.05, 0.3, 0.2}));
  all.emplace_back("cylinder with box", both);
  all.emplace_back("open sheet", sheet(0.4, 4));
  all.emplace_back("soup", soup(150, 0.6, 7));
  for (auto& [name, mesh] : all) move(mesh, generic_turn(), {0.11, -0.07, 0.05});
  return all;
}

}  // namespace lasso::mdat::shapes
