// A pose that its hits let slide (a plate within itself), settled by the scan's outline: which of its rays met the target and which passed
// it by. Labels (silhouette.hpp) measure that finely, but only from near; this stage brings the pose near.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/unseen.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

struct OutlineFit {
  Pose T_target_sensor;
  std::uint32_t rays = 0;      // that were asked: kHit or kMiss, and near the target
  std::uint32_t hits = 0;      // of them
  std::uint32_t disputed = 0;  // of all: a hit where the pose has no surface, or one farther off than the gate; a miss where it has one
  std::uint32_t gained = 0;    // how many fewer than where it began
  std::uint32_t asked = 0;     // how often a ray was asked of a pose
  bool settled = false;        // disputed is no more than kDisputed of the rays, kFewRays and the drop-outs to be expected
  // For each direction, m at the model's radius: that far off either way kFewRays more dispute the pose; 0 where that was not found, or
  // nothing is settled.
  Vec6 within_m = Vec6::Zero();
};
constexpr std::uint32_t kFewRays = 3;  // more than a pattern's chance
constexpr double kDisputed = 0.03;

struct OutlineCare {
  double gate_m;
  double first_step;    // of the model's radius
  double last_step_m;   // at it
  std::uint32_t asked;  // no step begins after so many questions
};

// Slides the pose along `directions` to where the fewest rays dispute it, by steps that double while they help and are halved where they do
// not, down to the last one. Bound: kOutlineRounds rounds, and `asked` plus four times kOutlineRays walks through the field.
OutlineFit fit_outline(const Mission& mission, const Pose& T_target_sensor, const Directions& directions, const OutlineCare& care,
                       Workspace& workspace);
constexpr int kOutlineRounds = 24;

}  // namespace lasso
