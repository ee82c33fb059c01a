#include "mdat/missiondb/mesh_facts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

// To a hundredth of the size: a person reads it, and the target stays in the middle of the field.
Vector3d rounded_center(const Vector3d& center, double largest_m) {
  const double unit = std::pow(10.0, std::floor(std::log10(largest_m)) - 2);
  return (center / unit).array().round() * unit;
}

// Twice the area, along the normal.
Vector3d area_vector(const Mesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

struct Edge {
  std::uint32_t a, b, triangle;
  bool operator<(const Edge& other) const { return std::tie(a, b, triangle) < std::tie(other.a, other.b, other.triangle); }
  bool joins(const Edge& other) const { return a == other.a && b == other.b; }
};

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
      edges.push_back({a, b, t});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void mark_coplanar(const Mesh& mesh, const std::vector<Edge>& edges, std::vector<bool>& regular) {
  constexpr double kCoplanar = 1 - 5e-7;  // cosine of 0.001 rad: files hold seven digits
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (!edges[i].joins(edges[i + 1])) continue;
    const std::uint32_t one = edges[i].triangle, two = edges[i + 1].triangle;
    const Vector3d n = area_vector(mesh, mesh.triangles[one]).normalized(), m = area_vector(mesh, mesh.triangles[two]).normalized();
    if (std::fabs(n.dot(m)) > kCoplanar) regular[one] = regular[two] = true;
  }
}

// By the lengths of their sides, in millionths of the size.
void mark_congruent(const Mesh& mesh, double largest_m, std::vector<bool>& regular) {
  constexpr double kUnit = 1e-6;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> seen;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::int64_t, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d side = mesh.vertices[mesh.triangles[t][i]] - mesh.vertices[mesh.triangles[t][(i + 1) % 3]];
      lengths[i] = std::llround(side.norm() / (kUnit * largest_m));
    }
    std::sort(lengths.begin(), lengths.end());
    const auto [place, fresh] = seen.try_emplace(lengths, t);
    if (!fresh) regular[t] = regular[place->second] = true;
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double roughness_m(const Mesh& mesh, const std::vector<Edge>& edges) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero()), sums = normals;
  std::vector<int> counts(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) normals[v] += area_vector(mesh, t);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i].joins(edges[i - 1])) continue;
    const auto [a, b, triangle] = edges[i];
    sums[a] += mesh.vertices[b];
    sums[b] += mesh.vertices[a];
    ++counts[a];
    ++counts[b];
  }
  std::vector<double> distances;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    if (counts[v] > 0) distances.push_back(std::fabs(normals[v].normalized().dot(sums[v] / counts[v] - mesh.vertices[v])));
  }
  return median(std::move(distances));
}

// Which vertices belong together, by union and find with halved paths.
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t part_of(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[part_of(a)] = part_of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

MeshSize size_of(const Mesh& mesh) {
  Vector3d low = mesh.vertices.at(0), high = low;
  for (const Vector3d& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  MeshSize size;
  size.sides = high - low;
  size.largest_m = size.sides.maxCoeff();
  size.center = rounded_center(0.5 * (low + high), size.largest_m);
  for (const Vector3d& v : mesh.vertices) size.radius_m = std::max(size.radius_m, (v - size.center).norm());
  return size;
}

SurfaceFacts surface_facts(const Mesh& mesh) {
  const std::vector<Edge> edges = edges_of(mesh);
  std::vector<bool> regular(mesh.triangles.size(), false);
  mark_coplanar(mesh, edges, regular);
  mark_congruent(mesh, size_of(mesh).largest_m, regular);
  SurfaceFacts facts;
  facts.triangles = mesh.triangles.size();
  for (const Triangle& t : mesh.triangles) facts.area_m2 += 0.5 * area_vector(mesh, t).norm();
  facts.regular_share = static_cast<double>(std::count(regular.begin(), regular.end(), true)) / static_cast<double>(regular.size());
  facts.roughness_m = roughness_m(mesh, edges);
  return facts;
}

std::vector<double> part_widths_m(const Mesh& mesh) {
  Parts parts(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  std::map<std::uint32_t, std::pair<Vector3d, Vector3d>> boxes;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      const Vector3d& p = mesh.vertices[v];
      auto& [low, high] = boxes.try_emplace(parts.part_of(v), p, p).first->second;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  std::vector<double> widths;
  for (const auto& [part, box] : boxes) {
    Vector3d sides = box.second - box.first;
    std::sort(sides.begin(), sides.end());
    widths.push_back(sides[1]);
  }
  return widths;
}

}  // namespace lasso::mdat
