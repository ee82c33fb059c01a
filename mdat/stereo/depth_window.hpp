// Between which depths a match is looked for.
#pragma once

#include <vector>

#include "mdat/modelc/mesh.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/matcher.hpp"

namespace lasso::mdat {

constexpr double kDepthMargin = 0.1;     // of a depth
constexpr double kNearestBaselines = 3;  // nearer than this no two cameras see the same

// Depths of a target in any attitude about `center_m`, a point in its frame, which is at one of these ranges (one at least), with the
// margin: nobody has to know where it is. A target that is nearer than what can be matched gives the nearest depths that can.
MatchDepths depths_at(const Mesh& target, const Vec3& center_m, const std::vector<double>& ranges_m, double baseline_m);

// By the ranges at which the mission has the target in this case: its one range, or all of the scenario that it flies through.
MatchDepths stated_depths(const Mesh& target, const CaseSetup& setup, double baseline_m);

}  // namespace lasso::mdat
