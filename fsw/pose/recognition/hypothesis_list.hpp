// The hypotheses of a search's short list, and of a pose that it suspects, on their way to the model.
#pragma once

#include "fsw/core/fixed_vector.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/pose/recognition/hypothesis_score.hpp"
#include "fsw/pose/recognition/quarter_turns.hpp"
#include "fsw/pose/recognition/view_matching.hpp"

namespace lasso {

constexpr std::size_t kAligned = 16;  // of those aligned by distances: so many are aligned along rays

struct AlignedHypothesis {
  Pose T_target_sensor;
  double score = 0;     // smaller is better: the mean distance, or the score once it is aligned along rays
  HypothesisScore fit;  // once it is aligned along rays
};

class HypothesisList {
 public:
  void clear() { list_.clear(); }
  void add(const Pose& T_target_sensor, double score);
  // Leaves the best, at most kAligned, best first; of those that came to the same attitude within 5 deg, one.
  void keep_best();
  std::size_t size() const { return list_.size(); }
  AlignedHypothesis& operator[](std::size_t i) { return list_[i]; }
  const AlignedHypothesis& operator[](std::size_t i) const { return list_[i]; }
  // The best score of the first `count`.
  double best_score(std::size_t count) const;

 private:
  FixedVector<AlignedHypothesis, kShortList + kQuarterTurns> list_;
};

}  // namespace lasso
