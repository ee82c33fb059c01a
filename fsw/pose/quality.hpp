// Can the pose be trusted? Self-checks of a registration against its own scan.
#pragma once

#include "fsw/pose/estimator.hpp"

namespace lasso {

// Share of rays whose hit or miss is as the pose predicts: inliers and unexplained returns from the registration, and a sample of the
// misses (at most kMissSamples) looked up in the field.
double hit_miss_agreement(const Mission& mission, const Pose& T_target_sensor, std::uint32_t inliers, std::uint32_t returns,
                          bool misses_known, const Workspace& workspace);

// Fills weak, weakest_sigma_m and weakest_direction from result.covariance.
void find_weak_directions(const Mission& mission, Registration& result);

// The first of the checks that fails, or kValid.
PoseReason judge(const MissionParameters& parameters, const Registration& result);

}  // namespace lasso
