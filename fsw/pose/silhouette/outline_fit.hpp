// A pose that its hits let slide (a plate within itself), fixed by the scan's outline: which of its rays met the target and which passed
// it by. Labels (silhouette.hpp) measure that finely, but only from near; this stage brings the pose near.
//
// A ray's cost is that of its gap, hit to surface, squared, up to three sigmas: a ray. So what the hits themselves fix is moved only
// where they are fewer than the rays that ask for it. A miss where there is a surface, and a hit where there is none, cost a ray.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

struct OutlineFit {
  Pose T_target_sensor;        // where it began, unless that costs kFewRays more and as many more rays dispute it
  std::uint32_t rays = 0;      // that were asked: kHit or kMiss, and near the target
  std::uint32_t hits = 0;      // of them
  std::uint32_t disputed = 0;  // of all: a hit where the pose has no surface, or one farther off than the gate; a miss where it has one
  std::uint32_t asked = 0;     // how often a ray was asked of a pose
  bool moved = false;
  bool settled = false;  // disputed is no more than kDisputedShare of the rays, kFewRays and the drop-outs to be expected
  // For each direction, m at the model's radius: that far off either way kFewRays more dispute the pose. It is one of the steps that were
  // tried, not the shortest; 0 where none was found, or nothing is decided.
  Vec6 within_m = Vec6::Zero();
};
constexpr std::uint32_t kFewRays = 3;  // more than a pattern's chance
constexpr double kDisputedShare = 0.05;

struct OutlineCare {
  double sigma_m = 0;                         // of a range
  double edge_depth_m = 0;                    // near its edges the model's field is that far off
  std::uint32_t asked = 0;                    // no step begins after so many questions,
  std::uint32_t measured = 4 * kOutlineRays;  // no longer step is measured after so many more
  double first_step = 0.06;                   // of the model's radius
  double last_step = 0.01;                    // the same
};

// Slides the pose along `directions` to where it costs less, by steps that double while they help by a ray and are halved where they do
// not, down to the last one or until `asked`. Bound: kOutlineRounds rounds, and `asked`, `measured` and fifteen times kOutlineRays walks
// through the field; and the bounds of find_contour and find_rays_near_contour, whose results it leaves in the workspace.
OutlineFit fit_outline(const Mission& mission, const Pose& T_target_sensor, const Directions& directions, const OutlineCare& care,
                       Workspace& workspace);
constexpr int kOutlineRounds = 24;
// What an estimate may ask, and once more where it has moved: a slot's time (docs/decisions/outline.md).
constexpr std::uint32_t kMostAsked = 1200;
constexpr std::uint32_t kMostAskedAgain = 600;

}  // namespace lasso
