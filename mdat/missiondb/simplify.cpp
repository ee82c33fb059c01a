#include "mdat/missiondb/simplify.hpp"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mdat/modelc/near_field.hpp"
#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kStlTextBytes = 80;

std::vector<float> positions_of(const Mesh& mesh) {
  std::vector<float> positions;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (const double x : v) positions.push_back(static_cast<float>(x));
  }
  return positions;
}

// Triangles that name a vertex twice would keep their vertices from every collapse.
std::vector<unsigned int> indices_of(const Mesh& mesh) {
  std::vector<unsigned int> indices;
  for (const auto& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) indices.insert(indices.end(), t.begin(), t.end());
  }
  return indices;
}

// By collapses of edges; where these stop early, as about a vertex in which very many triangles meet, by clusters of vertices.
std::vector<unsigned int> fewer(const std::vector<unsigned int>& indices, const std::vector<float>& positions, std::size_t triangles) {
  constexpr std::size_t kStride = 3 * sizeof(float);
  constexpr auto kError = static_cast<float>(kSimplifyError);
  std::vector<unsigned int> kept(indices.size());
  // No more than there are: meshoptimizer ends the program otherwise.
  const std::size_t wanted = std::min(3 * triangles, indices.size());
  const std::size_t count =
      meshopt_simplify(kept.data(), indices.data(), indices.size(), positions.data(), positions.size() / 3, kStride, wanted, kError);
  kept.resize(count);
  if (2 * count <= 3 * wanted) return kept;
  std::vector<unsigned int> clustered(indices.size());
  clustered.resize(meshopt_simplifySloppy(clustered.data(), indices.data(), indices.size(), positions.data(), positions.size() / 3, kStride,
                                          wanted, kError));
  return clustered.empty() ? kept : clustered;
}

Mesh coarser(const Mesh& mesh, std::size_t triangles) {
  const std::vector<float> positions = positions_of(mesh);
  std::vector<unsigned int> kept = fewer(indices_of(mesh), positions, triangles);
  Mesh result;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
  for (unsigned int& v : kept) {
    if (place[v] == kNone) {
      place[v] = static_cast<std::uint32_t>(result.vertices.size());
      const float* const p = &positions[3 * std::size_t{v}];  // as the file will say: GCC 12 -O2 leaves out a cast to float and back
      result.vertices.emplace_back(p[0], p[1], p[2]);
    }
    v = place[v];
  }
  for (std::size_t i = 0; i < kept.size(); i += 3) result.triangles.push_back({kept[i], kept[i + 1], kept[i + 2]});
  return result;
}

// Triangles with area, as the closest-point search takes them.
std::vector<Element> elements_of(const Mesh& mesh) {
  std::vector<Polygon> polygons;
  double reach_m = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) reach_m = std::max(reach_m, v.norm());
  for (const auto& t : mesh.triangles) {
    Polygon polygon;
    for (std::size_t i = 0; i < 3; ++i) polygon.corners[i] = mesh.vertices[t[i]];
    const Vec3d area = (polygon.corners[1] - polygon.corners[0]).cross(polygon.corners[2] - polygon.corners[0]);
    if (!(area.norm() > 0)) continue;
    polygon.normal = area.normalized();
    polygon.corners[3] = Vec3d::Zero();
    polygon.corner_normals = {polygon.normal, polygon.normal, polygon.normal, Vec3d::Zero()};
    polygons.push_back(polygon);
  }
  CompileReport report;
  return make_elements(polygons, LengthScale(reach_m), 0, report).list;
}

// Where a coarser surface may leave the one that was given, of which its vertices are: on a lattice over each face. Its seventh parts do
// not fall in step with what repeats, as halves do with ribs and slots.
std::vector<Eigen::Vector3d> lattice_of(const Mesh& mesh) {
  constexpr int kParts = 7;
  std::vector<Eigen::Vector3d> points;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    for (int i = 0; i <= kParts; ++i) {
      for (int k = 0; i + k <= kParts; ++k) points.push_back((i * a + k * b + (kParts - i - k) * c) / kParts);
    }
  }
  return points;
}

// The larger of what `result` has and the distances of points from a surface.
void measure(const std::vector<Eigen::Vector3d>& points, const Mesh& surface, Simplified& result) {
  const std::vector<Element> elements = elements_of(surface);
  if (elements.empty()) fail("nothing is left of the mesh: take more triangles");
  const NearestSearch nearest(elements);
  std::vector<double> distances(points.size());
  parallel_for(distances.size(), [&](std::size_t i) { distances[i] = nearest.closest(points[i]).distance_m; });
  double squares = 0;
  for (const double d : distances) squares += d * d;
  result.rms_m = std::max(result.rms_m, std::sqrt(squares / static_cast<double>(distances.size())));
  result.worst_m = std::max(result.worst_m, *std::max_element(distances.begin(), distances.end()));
}

void append(float value, std::string& bytes) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }

}  // namespace

Simplified simplify(const Mesh& mesh, std::size_t triangles) {
  Simplified result{coarser(mesh, triangles), 0, 0, mesh.triangles.size()};
  measure(mesh.vertices, result.mesh, result);
  measure(lattice_of(result.mesh), mesh, result);  // a face that bridges a slot lies on none of the vertices about it
  return result;
}

std::string stl_bytes(const Mesh& mesh) {
  std::string bytes(kStlTextBytes, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).stableNormalized();
    for (const double x : normal) append(static_cast<float>(x), bytes);
    for (const std::uint32_t v : t) {
      for (const double x : mesh.vertices[v]) append(static_cast<float>(x), bytes);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace lasso::mdat
