// A start of a search made a pose: drawn to the model, registered on a scan's evidence, and measured. In attempts of bounded work.
#pragma once

#include "fsw/pose/recognition/hypothesis_score.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

constexpr std::size_t kSketchPoints = 128;  // of the evidence

struct Settled {
  HitSolution solution;
  Fit fit;
};

struct SketchStart {
  Pose T_target_sensor;
  Fit fit;  // of this pose; Fit() where it is not known, which no registration strays from
};

// `work` is added to (work_units.hpp).

// The start registered on some of the returns, which tells whether it is worth more. The measuring ends beyond `limit`. A start that is
// known to fit is kept where the registration strays from it: a few returns and a wide gate may lead to another minimum.
Settled sketch(const Mission& mission, const Evidence& evidence, const SketchStart& start, double limit, Workspace& workspace,
               std::uint32_t& work);

// Settles one start in one scan, attempt by attempt, until one explains the scan.
class Settler {
 public:
  // `rough`: where to register from; `start`: where to draw it from, should that not do.
  void begin(const Pose& rough, const Pose& start);
  // One attempt. False when it was the last one, or led to a score beyond `limit`.
  bool step(const Mission& mission, const Evidence& evidence, double limit, Workspace& workspace, std::uint32_t& work);
  const Settled& best() const { return best_; }

 private:
  enum class Attempt : std::uint8_t { kFirst, kSecondLook, kDraw, kLast };
  // One registration on all returns, kept if it is the first or the best.
  void look(const Mission& mission, const Evidence& evidence, RegisterLook which, Workspace& workspace, std::uint32_t& work);

  Attempt attempt_ = Attempt::kFirst;
  Pose rough_, start_;
  Settled best_;
};

// Of measuring it (work_units.hpp).
std::uint32_t fit_work(const Fit& fit);

}  // namespace lasso
