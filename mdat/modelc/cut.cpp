#include "mdat/modelc/cut.hpp"

namespace lasso::mdat {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

// What of a convex polygon lies on the inner side of one plane, sign * p[axis] <= sign * place (Sutherland & Hodgman 1974).
Corners cut_by_plane(const Corners& polygon, int axis, double sign, double place) {
  Corners inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& from = polygon[i];
    const Eigen::Vector3d& to = polygon[(i + 1) % polygon.size()];
    const double depth_from = sign * (place - from[axis]);
    const double depth_to = sign * (place - to[axis]);
    if (depth_from >= 0) inside.push_back(from);
    if ((depth_from >= 0) != (depth_to >= 0)) inside.push_back(from + depth_from / (depth_from - depth_to) * (to - from));
  }
  return inside;
}

Corners cut_polygon(Corners polygon, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  for (int axis = 0; axis < 3; ++axis) {
    polygon = cut_by_plane(polygon, axis, 1, high[axis]);
    polygon = cut_by_plane(polygon, axis, -1, low[axis]);
  }
  return polygon;
}

void append_fan(const Corners& polygon, Mesh& mesh) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), polygon.begin(), polygon.end());
  for (std::uint32_t i = 2; i < polygon.size(); ++i) mesh.triangles.push_back({base, base + i - 1, base + i});
}

}  // namespace

Mesh cut_by_box(const Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Mesh result;
  for (const auto& triangle : mesh.triangles) {
    const Corners polygon = cut_polygon({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]}, low, high);
    if (polygon.size() >= 3) append_fan(polygon, result);
  }
  return result;
}

}  // namespace lasso::mdat
