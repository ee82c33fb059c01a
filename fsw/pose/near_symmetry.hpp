// The poses that one is most easily taken for: those that the model's near-symmetries make of it.
#pragma once

#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

constexpr std::size_t kTwinPoints = 256;  // of a scan's returns are enough to tell a pose from its twins

// T_target_sensor of a pose to that of its twin.
Pose twin_of(const NearSymmetry<FlightNumber>& symmetry, const Pose& T_target_sensor);

// By how much the best of the pose's twins, each registered, explains the scan that `workspace` holds (prepare_rays) better than the pose
// as it stands: squared residuals in sigmas (kUnexplainedCost for a return that is not explained) and violated misses, for a ray; negative
// where none does, -1e9 where no twin explains tracking.inliers_min of the scan's returns. Leaves every n-th point in the workspace. Bound:
// kMaxSymmetries registrations of kTwinPoints.
double twin_advantage(const Mission& mission, const Pose& T_target_sensor, bool misses_known, Workspace& workspace);

}  // namespace lasso
