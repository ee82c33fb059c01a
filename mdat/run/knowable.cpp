#include "mdat/run/knowable.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "mdat/run/bound.hpp"

namespace lasso::mdat {
namespace {

constexpr double kSigmas = 3;
constexpr int kLabels = 3;
constexpr double kJumpShare = 0.01, kJumpSigmas = 10;

using Triangle = std::array<std::uint32_t, 3>;

Vec3 area_vector(const Mesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

std::vector<Triangle> with_area(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(triangles),
               [&](const Triangle& t) { return area_vector(mesh, t).norm() > 0; });
  return triangles;
}

// A face at one of its corners: its unit normal, times its angle there, which does not depend on how a flat face is cut into triangles.
Vec3 corner_vector(const Mesh& mesh, const Triangle& t, std::size_t k) {
  const Vec3 &p = mesh.vertices[t[k]], &q = mesh.vertices[t[(k + 1) % 3]], &r = mesh.vertices[t[(k + 2) % 3]];
  return std::acos(std::clamp((q - p).normalized().dot((r - p).normalized()), -1.0, 1.0)) * area_vector(mesh, t).normalized();
}

// At each corner the mean, by angle, of the faces at its vertex that meet this one at less than the crease.
std::vector<std::array<Vec3, 3>> corner_normals(const Mesh& mesh, const std::vector<Triangle>& triangles, double crease_rad) {
  std::vector<std::vector<Vec3>> at_vertex(mesh.vertices.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) at_vertex[t[k]].push_back(corner_vector(mesh, t, k));
  }
  std::vector<std::array<Vec3, 3>> normals;
  for (const Triangle& t : triangles) {
    const Vec3 own = area_vector(mesh, t).normalized();
    normals.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = Vec3::Zero();
      for (const Vec3& other : at_vertex[t[k]]) {
        if (own.dot(other.normalized()) > std::cos(crease_rad)) sum += other;
      }
      normals.back()[k] = sum.normalized();
    }
  }
  return normals;
}

}  // namespace

struct KnowableTarget::Return {
  bool hit = false, measured = false;                         // by the noise-free ray; and the sensor had a range
  Vec3 p = Vec3::Zero(), n = Vec3::Zero(), u = Vec3::Zero();  // target axes
  double range_m = 0, depth_m = 0;
};

KnowableTarget::KnowableTarget(const Mesh& mesh, double crease_rad, const KnowableNoise& noise, double size_m)
    : noise_(noise), size_m_(size_m) {
  const std::vector<Triangle> triangles = with_area(mesh);
  normals_ = corner_normals(mesh, triangles, crease_rad);
  for (const Triangle& t : triangles) corners_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  surface_ = sim::make_ray_caster(mesh.vertices, triangles);
}

// Interpolated by the areas opposite of the corners.
Vec3 KnowableTarget::smooth_normal(std::uint32_t triangle, const Vec3& p) const {
  const auto& [a, b, c] = corners_[triangle];
  const Vec3 n = (b - a).cross(c - a).normalized();
  const double at_a = n.dot((b - p).cross(c - p)), at_b = n.dot((c - p).cross(a - p)), at_c = n.dot((a - p).cross(b - p));
  const auto& [n_a, n_b, n_c] = normals_[triangle];
  return (at_a * n_a + at_b * n_b + at_c * n_c).normalized();
}

double KnowableTarget::range_sigma_m(double depth_m) const { return std::hypot(noise_.sigma0_m, noise_.sigma_k_per_m * depth_m * depth_m); }

std::vector<KnowableTarget::Return> KnowableTarget::cast_all(const Pose& T_sensor_target, std::span<const RangeSample> scan) const {
  const Pose T_target_sensor = inverse(T_sensor_target);
  std::vector<Return> returns;
  for (const RangeSample& sample : scan) {
    if (sample.state != RayState::kHit && sample.state != RayState::kMiss) continue;
    Return found;
    const Vec3 direction = to_vec3(sample.direction);
    found.u = rotate(T_target_sensor.q, direction);
    const sim::RayHit hit = surface_->cast(T_target_sensor.p, found.u);
    found.hit = hit.hit;
    found.measured = hit.hit && sample.state == RayState::kHit;
    found.range_m = hit.range_m;
    found.depth_m = hit.range_m * direction.z();
    found.p = T_target_sensor.p + hit.range_m * found.u;
    if (hit.hit) found.n = smooth_normal(hit.triangle, found.p);
    returns.push_back(found);
  }
  return returns;
}

// Fisher information of (rotation, translation) in target axes, from each hit's distance along its normal.
Mat6 KnowableTarget::information_of(const std::vector<Return>& returns) const {
  Mat6 information = Mat6::Zero();
  for (const Return& hit : returns) {
    const double cosine = std::fabs(hit.n.dot(hit.u));
    if (!hit.measured || cosine < std::cos(kBoundIncidenceMax_rad)) continue;
    const double along = range_sigma_m(hit.depth_m), across = hit.range_m * noise_.sigma_angle_rad, surface = noise_.surface_sigma_m;
    const double variance = cosine * cosine * along * along + (1 - cosine * cosine) * across * across + surface * surface;
    Vec6 row;
    row << hit.p.cross(hit.n), hit.n;
    information += row * row.transpose() / variance;
  }
  return information;
}

int KnowableTarget::changed_labels(const std::vector<Return>& before, const std::vector<Return>& after) const {
  int count = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double jump_m = std::max(kJumpShare * size_m_, kJumpSigmas * range_sigma_m(before[i].depth_m));
    const bool same = before[i].hit == after[i].hit && !(std::fabs(before[i].range_m - after[i].range_m) > jump_m);
    count += same ? 0 : 1;
  }
  return count;
}

bool KnowableTarget::is_determined(const Pose& T_sensor_target, std::span<const RangeSample> scan) const {
  const std::vector<Return> returns = cast_all(T_sensor_target, scan);
  Vec6 limit;
  limit << Vec3::Constant(kWrongTurn_rad), Vec3::Constant(kWrongShare * size_m_);
  const Mat6 scale = (limit / kSigmas).asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat6> solved(scale * information_of(returns) * scale);
  for (int i = 0; i < 6; ++i) {
    if (solved.eigenvalues()[i] >= 1) continue;
    for (const double side : {-kSigmas, kSigmas}) {
      const Vec6 shift = side * scale * solved.eigenvectors().col(i);
      const Pose moved = T_sensor_target * Pose{exp_so3(shift.head<3>()), shift.tail<3>()};
      if (changed_labels(returns, cast_all(moved, scan)) < kLabels) return false;
    }
  }
  return true;
}

}  // namespace lasso::mdat
