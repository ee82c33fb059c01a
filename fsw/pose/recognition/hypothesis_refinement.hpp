// Refines a hypothesis of a search: aligned with the model, registered on the scan's subset, and scored. In attempts of bounded work.
#pragma once

#include "fsw/pose/recognition/hypothesis_score.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

constexpr std::size_t kFastRefinePoints = 128;  // of the scan subset

struct RefinedHypothesis {
  HitSolution solution;
  HypothesisScore fit;
};

struct FastRefineStart {
  Pose T_target_sensor;
  HypothesisScore fit;  // of this pose; HypothesisScore() where it is not known: then any registration is taken
};

// `work` is added to (work_units.hpp).

// The start registered on some of the returns, which tells whether it is worth more. The measuring ends beyond `limit`. A start that is
// known to fit is kept where the registration strays from it: a few returns and a wide gate may lead to another minimum.
RefinedHypothesis refine_fast(const Mission& mission, const ScanSubset& subset, const FastRefineStart& start, double limit,
                              Workspace& workspace, std::uint32_t& work);

// Refines one start in one scan, attempt by attempt, until one explains the scan.
class HypothesisRefiner {
 public:
  // `rough`: where to register from; `start`: where to align it from, should that not do.
  void begin(const Pose& rough, const Pose& start);
  // One attempt. False when it was the last one, or led to a score beyond `limit`.
  bool step(const Mission& mission, const ScanSubset& subset, double limit, Workspace& workspace, std::uint32_t& work);
  const RefinedHypothesis& best() const { return best_; }

 private:
  enum class Attempt : std::uint8_t { kFirst, kSecondLook, kAlignOnRays, kLast };
  // One registration on all returns, kept if it is the first or the best.
  void look(const Mission& mission, const ScanSubset& subset, RegisterLook which, Workspace& workspace, std::uint32_t& work);

  Attempt attempt_ = Attempt::kFirst;
  Pose rough_, start_;
  RefinedHypothesis best_;
};

// Of measuring it (work_units.hpp).
std::uint32_t score_work(const HypothesisScore& fit);

}  // namespace lasso
