// Between which depths a match is looked for.
#pragma once

#include "mdat/modelc/mesh.hpp"
#include "mdat/stereo/matcher.hpp"

namespace lasso::mdat {

constexpr double kDepthMargin = 0.1;     // of a depth, by which the predicted pose may be off
constexpr double kNearestBaselines = 3;  // nearer than this no two cameras see the same

// Depths of the box about the target where it is predicted to be, with the margin. A target that is behind the camera, or beside it, gives
// the nearest depths that can be matched.
MatchDepths predicted_depths(const Mesh& target, const Pose& T_sensor_target, double baseline_m);

}  // namespace lasso::mdat
