// Can the pose be trusted? Self-checks of a registration against its own scan.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/result.hpp"

namespace lasso {

// Fills weak, weakest_sigma_m and weakest_direction from result.covariance.
void find_weak_directions(const Mission& mission, Registration& result);

// Variance of residuals over that of the stated noise, from which on more than sensor.noise_tolerance is shown by so many inliers: of
// Gaussian residuals the ratio varies by sqrt(2 / degrees of freedom) (1 sigma), of which kNoiseSigmas are allowed. `inliers` is at least
// 12, the least tracking.inliers_min. `motion` is the variance that the target's unknown motion within the scan may add, over that of the
// stated noise.
double most_noise(const MissionParameters& parameters, std::uint32_t inliers, double motion);

// The first of the checks that fails, or kValid. `motion` as above.
PoseReason judge(const MissionParameters& parameters, const Registration& result, double motion);

}  // namespace lasso
