#include "fsw/pose/registration/agreement.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "fsw/pose/scan/model_ray.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kRangeSigmas = 5;
constexpr double kPoseSigmas = 2;
constexpr double kBeamSigmas = 2;
constexpr double kMostDoubt = 0.1;  // of the model's radius: farther off another surface explains what this one does not
constexpr double kDropoutSigmas = 3;
constexpr std::size_t kSides = 4;
constexpr std::uint32_t kRounds = 6;
constexpr std::uint32_t kGolden = 40503;     // 2^16 over the golden ratio: any first rays of a round are spread over scan and raster
constexpr std::uint32_t kEnough = 110;       // returns: where 5 % of them contradict, none of so many does once in 280 scans
constexpr std::uint32_t kMostLookedAt = 64;  // of returns, and of misses: further ones are taken for like these

double square(double x) { return x * x; }
double larger(double a, double b) { return a > b ? a : b; }

// The ranges at which a ray may meet the model.
struct RangeSpan {
  double near_m = 1e300;
  double far_m = -1e300;
  bool met = false;
  bool passed = false;  // it may meet nothing that the sensor measures, or what lies behind

  void include(const MissionParameters& p, const FieldHit<N>& hit) {
    const double range_m = N::to_double(hit.t);
    const bool measured = hit.found && range_m >= p.range_min_m && range_m <= p.range_max_m;
    met = met || hit.found;
    passed = passed || !measured;
    if (!hit.found) return;
    if (range_m < near_m) near_m = range_m;
    if (range_m > far_m) far_m = range_m;
  }

  // `farthest_m`: of the model.
  bool holds(const ScanRay<N>& ray, double variance_m2, double farthest_m) const {
    if (ray.state != RayState::kHit) return passed;
    if (!met) return false;
    const double range_m = N::to_double(ray.range);
    const double off_m = larger(near_m - range_m, range_m - (passed ? farthest_m : far_m));
    return off_m <= 0 || square(off_m) <= square(kRangeSigmas) * variance_m2;
  }
};

double length_of(const Vec3& v) { return square_root(v.squaredNorm()); }

// Of unit length, as u is.
Vec3 across_of(const Vec3& u) {
  const Vec3 across = u.cross(u.x() * u.x() < 0.5 ? Vec3::UnitX() : Vec3::UnitY());
  return across * (1 / length_of(across));
}

ScanRay<N> shifted(const ScanRay<N>& ray, const Vec3& by) {
  ScanRay<N> result = ray;
  for (int i = 0; i < 3; ++i) result.o[i] = bounded<N::Length>(ray.o[i] + N::to_length(by[i]));
  return result;
}

// Squared cosine of the incidence at which the ray meets the model; a curved surface's normal may be longer than 1.
double tilt2_of(const Mission& mission, const PathPose<N>& pose, const ScanRay<N>& ray, const FieldHit<N>& hit) {
  N::Length o[3];
  N::Unit u[3];
  transform(pose, ray.o, o);
  rotate(pose, ray.u, u);
  const N::Length q[3] = {o[0] + hit.t * u[0], o[1] + hit.t * u[1], o[2] + hit.t * u[2]};
  N::Unit normal[3];
  surface_normal(mission.field, mission.field.elements[hit.element], q, normal);
  return square(N::to_double(cut<N::Unit>(dot3<N>(normal, u))));
}

// Rays of one kind, returns or misses, that do not meet what the pose has them meet.
struct Unmet {
  std::uint32_t all = 0, looked_at = 0, contradicting = 0;

  // As many contradict of all as of those that were looked at.
  double odd() const { return looked_at > 0 ? static_cast<double>(contradicting) * all / looked_at : 0; }

  void take(const Expectation& expectation, const ScanRay<N>& ray, double variance_m2) {
    ++all;
    if (looked_at == kMostLookedAt) return;
    ++looked_at;
    contradicting += expectation.is_contradicted_by(ray, variance_m2) ? 1u : 0u;
  }
};

struct Count {
  std::uint32_t seen = 0;   // returns of the rounds so far
  std::uint32_t asked = 0;  // of these
  Unmet returns, misses;
};

void ask_return(const Expectation& expectation, const ScanRay<N>& ray, const MatchPoint<N>& point, Count& count) {
  ++count.seen;
  if (point.aimed) return;
  ++count.asked;
  const double variance_m2 = N::to_double(point.range_variance) + square(expectation.common_error_m(N::to_double(ray.range)));
  if (!expectation.is_met_by(ray, variance_m2)) count.returns.take(expectation, ray, variance_m2);
}

void ask_miss(const Expectation& expectation, const ScanRay<N>& ray, Count& count) {
  if (!expectation.is_met_by(ray, 0)) count.misses.take(expectation, ray, 0);
}

bool is_of_round(std::uint32_t round, std::uint32_t ray) { return (ray * kGolden % 65536) * kRounds / 65536 == round; }

// Asks the rays of one round. Points stand in the order of the rays that they are of.
void ask_round(const Expectation& expectation, bool misses_known, std::uint32_t round, const Workspace& workspace, Count& count) {
  std::size_t points = 0;
  for (std::uint32_t i = 0; i < workspace.rays.size(); ++i) {
    const ScanRay<N>& ray = workspace.rays[i];
    const bool hit = ray.state == RayState::kHit;
    const std::size_t point = points;
    points += hit ? 1u : 0u;
    if (!is_of_round(round, i)) continue;
    if (hit) ask_return(expectation, ray, workspace.points[point], count);
    if (!hit && misses_known) ask_miss(expectation, ray, count);
  }
}

// Of drop-outs beside so many returns: their number has a negative binomial distribution.
double forgiven_misses(const MissionParameters& p, std::uint32_t returns) {
  const double rest = 1 - p.dropout_probability;
  const double expected = returns * p.dropout_probability / rest;
  return expected + kDropoutSigmas * square_root(expected / rest);
}

double agreement_of(const MissionParameters& p, const Count& count) {
  const double odd_misses = larger(count.misses.odd() - forgiven_misses(p, count.seen), 0);
  const double blamed = larger(count.returns.odd() + odd_misses - kStray, 0);
  const double all = count.asked > 0 ? count.asked : count.seen;  // of a part's scan none is asked
  return blamed < all ? 1 - blamed / all : 0;
}

}  // namespace

Expectation::Expectation(const Mission& mission, const Pose& T_target_sensor, const PoseDoubt& doubt)
    : mission_(mission),
      poses_{},
      scale_(larger(doubt.noise_scale, 1)),
      beside_m_(kBeamSigmas * mission.parameters.sigma_angle_rad * length_of(T_target_sensor.p) + doubt.motion_m),
      farthest_m_(length_of(T_target_sensor.p) + mission.radius_m),
      least_tilt2_(square(sin_cos(mission.parameters.incidence_max_rad).cos)) {
  const double most_m = kMostDoubt * mission.radius_m;
  if (beside_m_ > most_m) beside_m_ = most_m;
  poses_[0] = to_path<N>(T_target_sensor);
  put_other_poses(T_target_sensor, doubt.covariance, most_m);
}

double Expectation::common_error_m(double range_m) const {
  const MissionParameters& p = mission_.parameters;
  return p.common_sigma_m + p.common_sigma_k_per_m * range_m * range_m;
}

// So far off along each of the least certain axes, either way.
void Expectation::put_other_poses(const Pose& T_target_sensor, const Mat6& covariance, double most_m) {
  const Eigen6 eigen = axes_at_radius(covariance, mission_.radius_m);
  for (std::size_t i = 0; i < kDoubtfulAxes; ++i) {
    const int axis = 5 - static_cast<int>(i);
    const double step_m = clamp(kPoseSigmas * square_root(larger(eigen.values[axis], 0)), 0.0, most_m);
    const Vec6 step = step_m * eigen.vectors.col(axis).cwiseQuotient(radius_scale(mission_.radius_m));
    for (std::size_t way = 0; way < 2; ++way) poses_[1 + 2 * i + way] = to_path<N>(step_pose(T_target_sensor, way == 0 ? step : -step));
  }
}

bool Expectation::is_met_by(const ScanRay<N>& ray, double range_variance_m2) const {
  RangeSpan span;
  span.include(mission_.parameters, meet_model(mission_, poses_[0], ray));
  const double variance_m2 = range_variance_m2 + square(mission_.parameters.surface_sigma_m);
  return span.met == (ray.state == RayState::kHit) && span.holds(ray, scale_ * variance_m2, farthest_m_);
}

bool Expectation::is_contradicted_by(const ScanRay<N>& ray, double range_variance_m2) const {
  if (is_met_by(ray, range_variance_m2)) return false;
  const MissionParameters& p = mission_.parameters;
  const FieldHit<N> first = meet_model(mission_, poses_[0], ray);
  const double tilt2 = first.found ? tilt2_of(mission_, poses_[0], ray, first) : 1;
  if (tilt2 < least_tilt2_) return false;
  const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
  const Vec3 across = across_of(u);
  const Vec3 sides[kSides] = {across, -across, u.cross(across), across.cross(u)};
  RangeSpan span;
  span.include(p, first);
  for (std::size_t i = 1; i < kPoses; ++i) span.include(p, meet_model(mission_, poses_[i], ray));
  for (std::size_t i = 0; i < kSides && beside_m_ > 0; ++i) {
    span.include(p, meet_model(mission_, poses_[0], shifted(ray, beside_m_ * sides[i])));
  }
  return !span.holds(ray, scale_ * (range_variance_m2 + square(p.surface_sigma_m) / tilt2), farthest_m_);
}

double agreement_of_rays(const Mission& mission, const Expectation& expectation, bool misses_known, const Workspace& workspace) {
  Count count;
  for (std::uint32_t round = 0; round < kRounds; ++round) {
    ask_round(expectation, misses_known, round, workspace, count);
    if (count.asked >= kEnough && count.returns.contradicting + count.misses.contradicting == 0) break;
  }
  return agreement_of(mission.parameters, count);
}

}  // namespace lasso
