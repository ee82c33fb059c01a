#include "mdat/missiondb/point_discs.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;
constexpr int kCorners = 8;
constexpr double kPiOf = std::numbers::pi;

Vector3d any_across(const Vector3d& unit) {
  const Vector3d other = std::abs(unit.x()) < 0.6 ? Vector3d(Vector3d::UnitX()) : Vector3d(Vector3d::UnitY());
  return unit.cross(other).normalized();
}

// Regular, of the area pi r^2: 8 triangles of R^2 sin(45 deg) / 2.
void add_disc(const Vector3d& point, const Vector3d& normal, double radius_m, Mesh& mesh) {
  const double corner_m = radius_m * std::sqrt(2 * kPiOf / (kCorners * std::sin(2 * kPiOf / kCorners)));
  const Vector3d right = any_across(normal), up = normal.cross(right);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2 * kPiOf * i / kCorners;
    mesh.vertices.emplace_back(point + corner_m * (std::cos(angle_rad) * right + std::sin(angle_rad) * up));
  }
  for (std::uint32_t i = 0; i < kDiscTriangles; ++i) mesh.triangles.push_back({first, first + i + 1, first + i + 2});
}

// Its surface is 4 sqrt(3) a^2 for corners at distance a.
void add_grain(const Vector3d& point, double radius_m, Mesh& mesh) {
  const double corner_m = radius_m * std::sqrt(kPiOf / std::sqrt(3.0));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) mesh.vertices.emplace_back(point + side * corner_m * Vector3d::Unit(axis));
  }
  for (std::uint32_t i = 0; i < kGrainTriangles; ++i) {
    const std::uint32_t x = first + (i & 1U), y = first + 2 + (i >> 1 & 1U), z = first + 4 + (i >> 2 & 1U);
    const bool even = ((i ^ i >> 1 ^ i >> 2) & 1U) == 0;  // corners run round the outward normal
    mesh.triangles.push_back(even ? Corners{x, y, z} : Corners{x, z, y});
  }
}

}  // namespace

PointCloud read_cloud(const std::filesystem::path& file) {
  std::string bytes;
  try {
    bytes = read_file(file);
  } catch (const std::runtime_error& error) {
    throw MeshError(error.what());
  }
  return read_ply_points(bytes);
}

Mesh disc_mesh(const PointCloud& cloud, double radius_m) {
  Mesh mesh;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.normals.empty()) {
      add_grain(cloud.points[i], radius_m, mesh);
    } else {
      add_disc(cloud.points[i], cloud.normals[i], radius_m, mesh);
    }
  }
  return mesh;
}

}  // namespace lasso::mdat
