#include "fsw/pose/quality.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/model_ray.hpp"
#include "fsw/pose/unseen.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
constexpr std::uint32_t kMissSamples = 64;
constexpr double kPoseDegrees = 6;
constexpr double kNoiseSigmas = 3;  // one good scan in 700 has exactly the noise that is tolerated, and shows more

struct MissSample {
  std::uint32_t misses = 0;  // all of them
  std::uint32_t looked_up = 0;
  std::uint32_t violated = 0;  // the model says that these should have hit
};

MissSample sample_misses(const Mission& mission, const Pose& T_target_sensor, const Workspace& workspace) {
  MissSample sample;
  for (const ScanRay<N>& ray : workspace.rays) sample.misses += ray.state == RayState::kMiss ? 1u : 0u;
  const std::uint32_t stride = sample.misses / kMissSamples + 1;
  const PathPose<N> pose = to_path<N>(T_target_sensor);
  std::uint32_t index = 0;
  for (const ScanRay<N>& ray : workspace.rays) {
    if (ray.state != RayState::kMiss || index++ % stride != 0) continue;
    ++sample.looked_up;
    if (meets_model(mission, pose, ray)) ++sample.violated;
  }
  return sample;
}

// The tighter of the position's limit and the attitude's, as a displacement at the model's radius.
double sigma_limit_m(const Mission& mission) {
  const double turn = mission.parameters.sigma_attitude_max_rad * mission.radius_m;
  const double shift = mission.parameters.sigma_position_max_m;
  return turn < shift ? turn : shift;
}

}  // namespace

double hit_miss_agreement(const Mission& mission, const Pose& T_target_sensor, std::uint32_t inliers, std::uint32_t returns,
                          bool misses_known, const Workspace& workspace) {
  double agreeing = inliers;
  double all = returns;
  if (misses_known) {
    const MissSample sample = sample_misses(mission, T_target_sensor, workspace);
    const double violated = sample.looked_up > 0 ? static_cast<double>(sample.violated) / sample.looked_up : 0;
    const double expected = mission.parameters.dropout_probability;  // drop-outs look like violated misses
    const double blamed = violated > expected ? violated - expected : 0;
    agreeing += sample.misses * (1 - blamed);
    all += sample.misses;
  }
  return all > 0 ? agreeing / all : 0;
}

void find_weak_directions(const Mission& mission, Registration& result) {
  const Vec6 scale = radius_scale(mission.radius_m);
  const Mat6 scaled = scale.asDiagonal() * result.covariance * scale.asDiagonal();
  const Eigen6 eigen = eigen6(scaled);
  const double limit_m = sigma_limit_m(mission);
  result.weak = 0;
  for (int i = 0; i < 6; ++i) result.weak = static_cast<std::uint16_t>(result.weak + (eigen.values[i] > limit_m * limit_m ? 1 : 0));
  result.weakest_sigma_m = square_root(eigen.values[5]);
  result.weakest_direction = eigen.vectors.col(5);
}

double most_noise(const MissionParameters& p, std::uint32_t inliers, double motion) {
  const double freedom = inliers - kPoseDegrees;
  return (p.noise_tolerance * p.noise_tolerance + motion) * (1 + kNoiseSigmas * square_root(2 / freedom));
}

PoseReason judge(const MissionParameters& p, const Registration& r, double motion) {
  if (r.returns < p.inliers_min) return PoseReason::kTooFewReturns;
  if (r.stop == StopReason::kSingular) return PoseReason::kSingular;
  if (r.stop == StopReason::kTooFewPoints || r.inliers < p.inliers_min) return PoseReason::kTooFewInliers;
  if (r.stop == StopReason::kIterationLimit) return PoseReason::kNotConverged;
  if (!(r.inlier_share >= p.inlier_share_min)) return PoseReason::kLowInlierShare;  // also what is not a number
  if (!(r.agreement >= p.agreement_min)) return PoseReason::kLowAgreement;
  if (!(r.normalized_residual * r.normalized_residual <= most_noise(p, r.inliers, motion))) return PoseReason::kHighResidual;
  return PoseReason::kValid;
}

}  // namespace lasso
