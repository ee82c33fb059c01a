#include "fsw/pose/recognition/hypothesis_list.hpp"

#include "fsw/pose/recognition/hypothesis_score.hpp"

namespace lasso {

void HypothesisList::add(const Pose& T_target_sensor, double score) {
  invariant(list_.push_back({T_target_sensor, score, HypothesisScore()}), "as many as are pulled");
}

void HypothesisList::keep_best() {
  std::size_t kept = 0;
  for (; kept < kAligned && kept < list_.size(); ++kept) {
    std::size_t best = kept;
    for (std::size_t i = kept + 1; i < list_.size(); ++i) {
      if (list_[i].score < list_[best].score) best = i;
    }
    const AlignedHypothesis chosen = list_[best];
    list_[best] = list_[kept];
    list_[kept] = chosen;
    std::size_t left = kept + 1;
    for (std::size_t i = left; i < list_.size(); ++i) {
      if (are_apart(chosen.T_target_sensor.q, list_[i].T_target_sensor.q, kCosHalfSame)) list_[left++] = list_[i];
    }
    list_.shrink(left);
  }
  list_.shrink(kept);
}

double HypothesisList::best_score(std::size_t count) const {
  double best = kAnyScore;
  for (std::size_t i = 0; i < count; ++i) {
    if (list_[i].score < best) best = list_[i].score;
  }
  return best;
}

}  // namespace lasso
