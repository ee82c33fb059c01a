#include "mdat/missiondb/file_mesh.hpp"

#include <Eigen/Geometry>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/solid.hpp"

namespace lasso::mdat {
namespace {

// Cutting a polygon takes the cube of its corners at worst, but only the square where it is convex. A file's tests take seconds at most.
constexpr std::size_t kMaxCorners = 1000;
constexpr std::size_t kMaxTests = 1'000'000'000;

// The corners in a plane across the polygon's mean normal (Newell), in which it runs counter-clockwise.
std::vector<Eigen::Vector2d> flattened(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.normalized().cross(u);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3d& corner : corners) points.emplace_back(u.dot(corner - corners[0]), v.dot(corner - corners[0]));
  return points;
}

}  // namespace

void add_polygon(FileMesh& mesh, const std::vector<std::uint32_t>& corners) {
  if (corners.size() < 3) {
    throw MeshError("has a face of " + std::to_string(corners.size()) + " corners, expected at least 3: the file is truncated or corrupt");
  }
  if (corners.size() == 3) return mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  if (corners.size() > kMaxCorners) {
    throw MeshError("has a face of " + std::to_string(corners.size()) + " corners, at most " + std::to_string(kMaxCorners) +
                    " are cut into triangles: export triangles");
  }
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t corner : corners) {
    if (corner >= mesh.vertices.size()) throw MeshError("has a face that refers to a vertex that is not there");
    points.push_back(mesh.vertices[corner]);
  }
  for (const auto& triangle : triangulate_polygon(flattened(points), &mesh.cut_tests)) {
    mesh.triangles.push_back({corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]});
  }
  if (mesh.cut_tests > kMaxTests) {
    throw MeshError("has too many faces of many corners that are not convex (this one has " + std::to_string(corners.size()) +
                    "): export triangles");
  }
}

void add_strip(FileMesh& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const bool turned = i % 2 == 1;
    const std::array<std::uint32_t, 3> triangle{corners[turned ? i + 1 : i], corners[turned ? i : i + 1], corners[i + 2]};
    const bool flat = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!flat) mesh.triangles.push_back(triangle);
  }
}

}  // namespace lasso::mdat
