// How well a pose explains a scan's subset: returns on the surface, nothing in front of them, and misses that pass by.
#pragma once

#include "fsw/geometry/se3.hpp"
#include "fsw/pose/recognition/scan_subset.hpp"

namespace lasso {

struct HypothesisScore {
  double hits = 0;          // returns looked at
  double bad = 0;           // of them: off the surface, or behind it
  double violated = 0;      // misses that the model would have returned, in terms of hits and weighted
  double distance = 0;      // sum over the returns of the distance from the surface over the truncation, each at most 1
  std::uint32_t walks = 0;  // rays that were looked at

  // Share of what was looked at that the pose does not explain, 0..1; 1 where nothing was.
  double disagreement() const;
  // What candidates are ranked by, smaller is better: disagreement and half the mean distance.
  double score() const;
};

HypothesisScore operator+(const HypothesisScore& a, const HypothesisScore& b);

constexpr double kAnyScore = 1e9;

// Where the best of all scores is this, what fits worse than the result is not worked on.
double hopeless_beyond(double score);
// And this is not worth a second attempt.
double poor_beyond(double score);

// At most kSubsetHits + kSubsetMisses walks through the field. Where the score is sure to exceed `limit`, no more are looked at; with a
// head start of fewer than all returns, as soon as it exceeds the limit's share of those looked at and so many more, as it is likely to.
// What is left among its returns is scored as if the others were like those looked at, and among its misses as if the others were met by
// nothing: beyond the limit, but not what all would say.
HypothesisScore measure_score(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, double limit = kAnyScore,
                              std::size_t head_start = kSubsetHits);

}  // namespace lasso
