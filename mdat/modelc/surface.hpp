// The repaired surface that the later stages work on.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace lasso::mdat {

using Vec3d = Eigen::Vector3d;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// Triangles of welded vertices. A sliver is thinner than the weld tolerance: it keeps its neighbours connected but is no surface of its
// own and counts as a flap of the neighbour across its longest edge.
struct Surface {
  std::vector<Vec3d> vertices;  // metres, target frame; all are used
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3d> normals;           // unit, per triangle; a sliver's is meaningless
  std::vector<std::uint8_t> sliver;     // per triangle
  std::vector<std::uint8_t> two_sided;  // per triangle
  Vec3d low, high;                      // bounding box
  double extent = 0;                    // its longest side

  const Vec3d& corner(std::size_t triangle, int i) const { return vertices[triangles[triangle][static_cast<std::size_t>(i)]]; }
  void flip(std::size_t triangle) {
    std::swap(triangles[triangle][1], triangles[triangle][2]);
    normals[triangle] = -normals[triangle];
  }
};

// One triangle's use of an edge; `forward` if the triangle runs from a to b (a < b).
struct EdgeUse {
  std::uint32_t a, b, triangle;
  std::uint8_t side;  // edge from corner `side` to the next
  bool forward;
};

}  // namespace lasso::mdat
