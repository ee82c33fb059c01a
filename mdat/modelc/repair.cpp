#include "mdat/modelc/repair.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace lasso::mdat {
namespace {

void check_mesh(const Mesh& mesh) {
  if (mesh.triangles.empty() || mesh.vertices.empty()) fail("the mesh has no triangles");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) fail("vertex ", i, " is not finite: ", mesh.vertices[i].transpose());
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (v >= mesh.vertices.size()) fail("triangle ", i, " names vertex ", v, " of ", mesh.vertices.size());
    }
  }
}

void measure(const Mesh& mesh, Surface& surface) {
  surface.low = surface.high = mesh.vertices[mesh.triangles[0][0]];
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      surface.low = surface.low.cwiseMin(mesh.vertices[v]);
      surface.high = surface.high.cwiseMax(mesh.vertices[v]);
    }
  }
  surface.extent = (surface.high - surface.low).maxCoeff();
  const double reach = std::max(surface.low.cwiseAbs().maxCoeff(), surface.high.cwiseAbs().maxCoeff());
  if (surface.extent < kExtentMin_m) {
    fail("the model's largest extent is ", surface.extent, " m, at least ", kExtentMin_m, " m are expected: is the scale right?");
  }
  if (surface.extent > kExtentMax_m || reach > 2 * kExtentMax_m) {
    fail("the model's largest extent is ", surface.extent, " m (farthest coordinate ", reach, " m), at most ", kExtentMax_m,
         " m are expected: is the scale right?");
  }
}

// Hash grid whose buckets are one tolerance wide: equal vertices lie in the same bucket or in a neighbour.
class Welder {
 public:
  Welder(double tolerance, std::vector<Vec3d>& vertices) : tolerance_(tolerance), vertices_(vertices) {}

  std::uint32_t index_of(const Vec3d& p) {
    const std::uint32_t known = find(p);
    if (known != kNone) return known;
    const auto index = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(p);
    next_.push_back(kNone);
    auto [head, fresh] = heads_.try_emplace(key(place(p)), index);
    if (!fresh) next_[index] = std::exchange(head->second, index);
    return index;
  }

 private:
  using Place = Eigen::Matrix<std::int64_t, 3, 1>;

  Place place(const Vec3d& p) const { return (p / tolerance_).array().floor().cast<std::int64_t>(); }
  static std::uint64_t key(const Place& place) {
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = (hash ^ static_cast<std::uint64_t>(place[i])) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 29);
  }
  std::uint32_t find(const Vec3d& p) const {
    const Place center = place(p);
    std::uint32_t best = kNone;
    for (int i = 0; i < 27; ++i) best = std::min(best, find_in(center + Place(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), p));
    return best;
  }
  std::uint32_t find_in(const Place& bucket, const Vec3d& p) const {
    std::uint32_t best = kNone;
    const auto head = heads_.find(key(bucket));
    for (std::uint32_t i = head == heads_.end() ? kNone : head->second; i != kNone; i = next_[i]) {
      if ((vertices_[i] - p).norm() <= tolerance_) best = std::min(best, i);
    }
    return best;
  }

  double tolerance_;
  std::vector<Vec3d>& vertices_;
  std::vector<std::uint32_t> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
};

struct TriangleHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& t) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t v : t) hash = (hash ^ v) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 31);
  }
};

bool same_winding(std::array<std::uint32_t, 3> a, const std::array<std::uint32_t, 3>& b) {
  std::rotate(a.begin(), std::find(a.begin(), a.end(), b[0]), a.end());
  return a == b;
}

void append_triangle(const std::array<std::uint32_t, 3>& triangle, double tolerance, Surface& surface) {
  const auto& v = surface.vertices;
  const Vec3d ab = v[triangle[1]] - v[triangle[0]], ac = v[triangle[2]] - v[triangle[0]];
  const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  const Vec3d area2 = ab.cross(ac);
  surface.triangles.push_back(triangle);
  surface.sliver.push_back(area2.norm() < tolerance * longest);
  surface.two_sided.push_back(false);
  const Vec3d none = Vec3d::Zero();
  surface.normals.push_back(surface.sliver.back() ? none : area2.normalized());
}

using SeenTriangles = std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, TriangleHash>;

void take_triangle(const std::array<std::uint32_t, 3>& t, double tolerance, SeenTriangles& seen, Surface& surface, CompileReport& report) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
    ++report.dropped_degenerate;
    return;
  }
  auto sorted = t;
  std::sort(sorted.begin(), sorted.end());
  const auto [place, fresh] = seen.try_emplace(sorted, static_cast<std::uint32_t>(surface.triangles.size()));
  if (!fresh) {
    ++report.dropped_duplicates;
    if (!same_winding(t, surface.triangles[place->second])) surface.two_sided[place->second] = true;
    return;
  }
  append_triangle(t, tolerance, surface);
  report.dropped_degenerate += surface.sliver.back();
}

}  // namespace

Surface repair_mesh(const Mesh& mesh, double weld_tolerance_m, CompileReport& report) {
  check_mesh(mesh);
  Surface surface;
  measure(mesh, surface);
  report.weld_tolerance_m = weld_tolerance_m > 0 ? weld_tolerance_m : 1e-6 * surface.extent;
  Welder welder(report.weld_tolerance_m, surface.vertices);
  std::vector<std::uint32_t> welded(mesh.vertices.size(), kNone);
  std::size_t used = 0;
  SeenTriangles seen;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> t;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& index = welded[triangle[i]];
      if (index == kNone) {
        index = welder.index_of(mesh.vertices[triangle[i]]);
        ++used;
      }
      t[i] = index;
    }
    take_triangle(t, report.weld_tolerance_m, seen, surface, report);
  }
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  report.welded_vertices = used - surface.vertices.size();
  report.unused_vertices = mesh.vertices.size() - used;
  const bool any = std::find(surface.sliver.begin(), surface.sliver.end(), 0) != surface.sliver.end();
  if (!any) fail("all ", mesh.triangles.size(), " triangles are thinner than the weld tolerance of ", report.weld_tolerance_m, " m");
  return surface;
}

}  // namespace lasso::mdat
