#include "ft/bodies/likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/mission/field.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "fsw/pose/scan/model_ray.hpp"

namespace lasso::bodies {
namespace {

using N = FlightNumber;

constexpr double kExplainedSigmas = 3;
constexpr double kNodeSigmas = 2;
constexpr double kMostDoubt = 0.1;  // of the model's radius: farther off another surface explains what this one does not
constexpr int kDoubtfulAxes = 3;
constexpr double kOwnWeight = 0.5;
constexpr double kMixedShare = 0.25;
constexpr double kApartSigmas = 4;  // ranges of nodes farther apart are of two surfaces
constexpr double kGrazingLost = 0.5;
constexpr double kLeastTilt2 = 1e-4;
constexpr double kLeastStray = 1e-3;

double square(double x) { return x * x; }

// What one line through the model meets.
struct Node {
  double weight = 1;
  bool met = false;
  double range_m = 0;
  double tilt2 = 1;  // squared cosine of the incidence
};

// A ray, with the noise of its return.
struct Measured {
  const ScanRay<N>& ray;
  double range_m = 0, range_variance = 0, across_variance = 0;
};

class Score {
 public:
  Score(const Mission& mission, const Registration& found)
      : mission_(mission),
        p_(mission.parameters),
        stray_(std::max(1 - p_.agreement_min, kLeastStray)),
        least_tilt2_(square(std::cos(p_.incidence_max_rad))),
        beside_m_(kNodeSigmas * std::hypot(p_.sigma_angle_rad * found.T_sensor_target.p.norm(), p_.surface_sigma_m)) {
    const Pose T_target_sensor = inverse(found.T_sensor_target);
    pose_ = to_path<N>(T_target_sensor);
    const Eigen6 eigen = axes_at_radius(rotated_covariance(to_matrix(T_target_sensor.q), found.covariance), mission.radius_m);
    for (int axis = 5; axis > 5 - kDoubtfulAxes; --axis) {
      const double sigma_m = std::sqrt(std::max(eigen.values[axis], 0.0));
      const double step_m = std::min(kNodeSigmas * sigma_m, kMostDoubt * static_cast<double>(mission.radius_m));
      const Vec6 step = step_m * eigen.vectors.col(axis).cwiseQuotient(radius_scale(mission.radius_m));
      for (const double way : {1, -1}) others_.push_back(to_path<N>(step_pose(T_target_sensor, way * step)));
    }
  }

  double of(const Measured& measured) const {
    std::vector<Node> nodes{node_of(pose_, measured.ray, 1)};
    if (!is_explained(measured, nodes.front())) add_doubt(measured.ray, nodes);
    return std::log(measured.ray.state == RayState::kHit ? density(measured, nodes) : stray_ + (1 - stray_) * lost_share(nodes));
  }

 private:
  Node node_of(const PathPose<N>& pose, const ScanRay<N>& ray, double weight) const {
    const FieldHit<N> hit = meet_model(mission_, pose, ray);
    if (!hit.found) return {weight};
    N::Length o[3];
    N::Unit u[3];
    transform(pose, ray.o, o);
    rotate(pose, ray.u, u);
    const N::Length q[3] = {o[0] + hit.t * u[0], o[1] + hit.t * u[1], o[2] + hit.t * u[2]};
    N::Unit normal[3];
    surface_normal(mission_.field, mission_.field.elements[hit.element], q, normal);
    const double tilt2 = square(N::to_double(cut<N::Unit>(dot3<N>(normal, u))));
    return {weight, true, N::to_double(hit.t), std::clamp(tilt2, kLeastTilt2, 1.0)};
  }

  void add_doubt(const ScanRay<N>& ray, std::vector<Node>& nodes) const {
    nodes.front().weight = kOwnWeight;
    const double rest = (1 - kOwnWeight) / 2;
    for (const PathPose<N>& other : others_) nodes.push_back(node_of(other, ray, rest / static_cast<double>(others_.size())));
    const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
    const Vec3 a = u.unitOrthogonal(), b = u.cross(a);
    for (const Vec3& side : {a, Vec3(-a), b, Vec3(-b)}) {
      ScanRay<N> beside = ray;
      for (int i = 0; i < 3; ++i) beside.o[i] = bounded<N::Length>(ray.o[i] + N::to_length(beside_m_ * side[i]));
      nodes.push_back(node_of(pose_, beside, rest / 4));
    }
  }

  double variance_of(const Measured& measured, const Node& node) const {
    const double across = measured.across_variance * (1 - node.tilt2) + square(p_.surface_sigma_m);
    return measured.range_variance + across / node.tilt2;
  }

  bool is_explained(const Measured& measured, const Node& node) const {
    if (measured.ray.state != RayState::kHit) return !node.met;
    return node.met && square(measured.range_m - node.range_m) < square(kExplainedSigmas) * variance_of(measured, node);
  }

  double lost(const Node& node) const {
    if (!node.met || node.range_m < p_.range_min_m || node.range_m > p_.range_max_m) return 1;
    return node.tilt2 < least_tilt2_ ? kGrazingLost : p_.dropout_probability;
  }

  double lost_share(const std::vector<Node>& nodes) const {
    double share = 0;
    for (const Node& node : nodes) share += node.weight * lost(node);
    return share;
  }

  double density(const Measured& measured, const std::vector<Node>& nodes) const {
    double density = 0, near_m = 1e300, far_m = -1e300;
    for (const Node& node : nodes) {
      if (!node.met) continue;
      const double variance = variance_of(measured, node);
      const double off2 = square(measured.range_m - node.range_m);
      density += node.weight * (1 - lost(node)) * std::exp(-0.5 * off2 / variance) / std::sqrt(2 * kPi * variance);
      near_m = std::min(near_m, node.range_m);
      far_m = std::max(far_m, node.range_m);
    }
    if (far_m - near_m > kApartSigmas * std::sqrt(measured.range_variance)) {
      const bool between = measured.range_m > near_m && measured.range_m < far_m;
      const double even = between ? (1 - lost_share(nodes)) / (far_m - near_m) : 0;
      density = (1 - kMixedShare) * density + kMixedShare * even;
    }
    return (1 - stray_) * density + stray_ / (p_.range_max_m - p_.range_min_m);
  }

  const Mission& mission_;
  const MissionParameters& p_;
  double stray_, least_tilt2_, beside_m_;
  PathPose<N> pose_{};
  std::vector<PathPose<N>> others_;
};

}  // namespace

double log_likelihood(const Mission& mission, const Registration& found, bool misses_known, const Workspace& workspace) {
  const Score score(mission, found);
  double sum = 0;
  std::size_t point = 0;
  for (const ScanRay<N>& ray : workspace.rays) {
    if (ray.state != RayState::kHit) {
      if (misses_known) sum += score.of({ray});
      continue;
    }
    const MatchPoint<N>& p = workspace.points[point++];
    sum += score.of({ray, N::to_double(ray.range), N::to_double(p.range_variance), N::to_double(p.across_variance)});
  }
  return sum;
}

}  // namespace lasso::bodies
