// The poses that one is most easily taken for: those that the model's near-symmetries make of it.
#pragma once

#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

constexpr std::size_t kTwinPoints = 256;  // of a scan's returns are enough to tell a pose from its twins

// T_target_sensor of a pose to that of its twin.
Pose twin_of(const NearSymmetry<FlightNumber>& symmetry, const Pose& T_target_sensor);

// Share of rays whose hit or miss is as the pose predicts: inliers and unexplained returns from the registration, and a sample of the
// misses, 64 at most, looked up in the field; as many as stated drop-outs explain are not blamed. 0 without any ray.
double hit_miss_agreement(const Mission& mission, const Pose& T_target_sensor, std::uint32_t inliers, std::uint32_t returns,
                          bool misses_known, const Workspace& workspace);

// Does one of the pose's twins explain the scan that `workspace` holds (prepare_rays) better than the pose, by more than `margin`: squared
// residuals in sigmas (kUnexplainedCost for a return that is not explained) and violated misses, for a ray that is kept? All are compared
// as registered on every n-th return, which stay in the workspace; misses are all kept. A twin has to explain tracking.inliers_min of the
// scan's returns. Bound: kMaxSymmetries + 1 registrations of kTwinPoints, pulls on rays for as many twins, and as many agreements.
bool has_twin_better_by(const Mission& mission, double margin, const Pose& T_target_sensor, bool misses_known, Workspace& workspace);

}  // namespace lasso
