#include "ft/bench/sampling.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_set>

#include "hal_sim/random.hpp"

namespace lasso::bench {
namespace {

constexpr std::size_t kOversampling = 8;
constexpr int kGridSearches = 6;
constexpr std::uint64_t kSeed = 11;

struct Corners {
  Eigen::Vector3d a, ab, ac;
  explicit Corners(const mdat::Mesh& mesh, const std::array<std::uint32_t, 3>& triangle)
      : a(mesh.vertices[triangle[0]]), ab(mesh.vertices[triangle[1]] - a), ac(mesh.vertices[triangle[2]] - a) {}
  Eigen::Vector3d area() const { return ab.cross(ac) / 2; }
};

double area_m2(const mdat::Mesh& mesh) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) sum += Corners(mesh, triangle).area().norm();
  return sum;
}

Triple to_triple(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

// Uniform in area: each triangle gets its share, the fractions carried over from one to the next.
PeerCloud sample_randomly(const mdat::Mesh& mesh, std::size_t count) {
  const double points_per_m2 = static_cast<double>(count) / area_m2(mesh);
  sim::Random random(kSeed);
  PeerCloud cloud;
  double owed = random.uniform();
  for (const auto& triangle : mesh.triangles) {
    const Corners corners(mesh, triangle);
    const double area = corners.area().norm();
    for (owed += area * points_per_m2; owed >= 1; owed -= 1) {
      const double outward = std::sqrt(random.uniform()), across = random.uniform();
      cloud.points_m.push_back(to_triple(corners.a + outward * ((1 - across) * corners.ab + across * corners.ac)));
      cloud.normals.push_back(to_triple(corners.area() / area));
    }
  }
  return cloud;
}

// Cell and main direction of a point, 20 bits an axis.
std::uint64_t cell_of(const Triple& p, const Triple& normal, double cell_m) {
  std::uint64_t axis = 0;
  for (std::uint64_t i = 1; i < 3; ++i) axis = std::fabs(normal[i]) > std::fabs(normal[axis]) ? i : axis;
  std::uint64_t key = 2 * axis + (normal[axis] > 0 ? 1 : 0);
  for (const double x : p) key = key << 20 | (static_cast<std::uint64_t>(std::llround(std::floor(x / cell_m)) + (1 << 19)) & 0xFFFFF);
  return key;
}

PeerCloud thin_out(const PeerCloud& cloud, double cell_m) {
  std::unordered_set<std::uint64_t> taken;
  PeerCloud result;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (!taken.insert(cell_of(cloud.points_m[i], cloud.normals[i], cell_m)).second) continue;
    result.points_m.push_back(cloud.points_m[i]);
    result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

}  // namespace

PeerMesh to_peer_mesh(const mdat::Mesh& mesh) {
  PeerMesh result;
  for (const Eigen::Vector3d& vertex : mesh.vertices) result.vertices_m.push_back(to_triple(vertex));
  result.triangles = mesh.triangles;
  return result;
}

double spacing_m(const mdat::Mesh& mesh, std::size_t count) { return std::sqrt(area_m2(mesh) / static_cast<double>(count)); }

PeerCloud sample_evenly(const mdat::Mesh& mesh, std::size_t count) {
  const PeerCloud dense = sample_randomly(mesh, kOversampling * count);
  double cell_m = spacing_m(mesh, count);
  PeerCloud result = thin_out(dense, cell_m);
  for (int i = 1; i < kGridSearches; ++i) {  // the number of cells goes with the inverse square of their size
    cell_m *= std::sqrt(static_cast<double>(result.points_m.size()) / static_cast<double>(count));
    result = thin_out(dense, cell_m);
  }
  return result;
}

}  // namespace lasso::bench
