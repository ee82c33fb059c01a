// How far a moved surface is from where it was: closest points of triangles, by brute force.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mdat/modelc/mesh.hpp"
#include "mdat/modelc/random.hpp"

namespace lasso::mdat {

inline double segment_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-30), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

inline double triangle_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const bool above =
      n.squaredNorm() > 0 && n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  if (above) return std::fabs(n.normalized().dot(p - a));
  return std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

inline double surface_distance(const Mesh& mesh, const Eigen::Vector3d& p) {
  double least = 1e9;
  for (const auto& t : mesh.triangles)
    least = std::min(least, triangle_distance(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  return least;
}

// The farthest that one of `count` points on the surface is from it after the turn about `center`; each triangle is as likely as another.
inline double farthest_after(const Mesh& mesh, const Eigen::Quaterniond& turn, const Eigen::Vector3d& center, int count) {
  Random random(1);
  double farthest = 0;
  for (int i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.triangles.size()))];
    const double u = random.uniform(), v = (1 - u) * random.uniform();
    const Eigen::Vector3d p = (1 - u - v) * mesh.vertices[t[0]] + u * mesh.vertices[t[1]] + v * mesh.vertices[t[2]];
    farthest = std::max(farthest, surface_distance(mesh, center + turn * (p - center)));
  }
  return farthest;
}

}  // namespace lasso::mdat
