// Silhouettes: rays near the model's contour say on which side of it they passed, by hitting or missing. This stage finds those labels;
// label_update.hpp turns them into information.
//
// A contour is an edge with one face towards the sensor and one away. It is confirmed by two probe rays a little to either side of it: one
// meets the model at the edge, the other passes and meets nothing (outer contour) or something clearly farther away (inner contour).
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

struct LabelSearch {
  bool misses_known = true;  // false: a ray without return says nothing
  Mat6 covariance =
      Mat6::Zero();  // of the pose before the labels, target axes (rotation, translation): labels that it makes certain are left out
  double range_sigma_m = 0;  // of a return at the target's range
  double band_m = 0;         // farther from a contour no labels are looked for
};

// Fills workspace.labels from workspace.rays at the pose T_target_sensor. Bounds: the model's edges, kMaxContourEdges, four contour edges a
// ray, kMaxSites labels; what exceeds them is left out in the order of the rays.
void find_labels(const Mission& mission, const Pose& T_target_sensor, const LabelSearch& search, Workspace& workspace);

}  // namespace lasso
