// The hypotheses of a search's short list, and of a pose that it suspects, on their way to the model.
#pragma once

#include "fsw/core/fixed_vector.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/pose/recognition/view_matching.hpp"
#include "fsw/pose/recognition/hypothesis_score.hpp"
#include "fsw/pose/recognition/quarter_turns.hpp"

namespace lasso {

constexpr std::size_t kDrawn = 16;  // of those that are pulled: so many are worth more

struct Drawn {
  Pose T_target_sensor;
  double score = 0;  // smaller is better: the mean distance when pulled, the fit's score when drawn on rays
  Fit fit;           // once it is drawn on rays
};

class DrawnList {
 public:
  void clear() { list_.clear(); }
  void add(const Pose& T_target_sensor, double score);
  // Leaves the best, at most kDrawn, best first; of those that came to the same attitude within 5 deg, one.
  void keep_best();
  std::size_t size() const { return list_.size(); }
  Drawn& operator[](std::size_t i) { return list_[i]; }
  const Drawn& operator[](std::size_t i) const { return list_[i]; }
  // The best score of the first `count`.
  double best_score(std::size_t count) const;

 private:
  FixedVector<Drawn, kShortList + kQuarterTurns> list_;
};

}  // namespace lasso
