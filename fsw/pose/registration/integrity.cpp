#include "fsw/pose/registration/integrity.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/observability.hpp"

namespace lasso {
namespace {

constexpr double kPoseDegrees = 6;
constexpr double kNoiseSigmas = 3;  // of scans whose noise is just what is tolerated, one in 700 is refused

// The tighter of the position's limit and the attitude's, as a displacement at the model's radius.
double sigma_limit_m(const Mission& mission) {
  const double turn = mission.parameters.sigma_attitude_max_rad * mission.radius_m;
  const double shift = mission.parameters.sigma_position_max_m;
  return turn < shift ? turn : shift;
}

}  // namespace

void find_weak_directions(const Mission& mission, Registration& result) {
  const Eigen6 eigen = axes_at_radius(result.covariance, mission.radius_m);
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
  if (!(r.agreement >= p.agreement_min)) return PoseReason::kModelMismatch;
  if (!(r.normalized_residual * r.normalized_residual <= most_noise(p, r.inliers, motion))) return PoseReason::kHighResidual;
  return PoseReason::kValid;
}

}  // namespace lasso
