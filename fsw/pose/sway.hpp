// Is there a place near a pose that explains the returns better?
//
// A part of the target that is not where the model has it, but turned a little, pulls the pose towards itself until the other parts fit
// badly: a minimum, but not the best one. Where a pose leaves returns unexplained it is turned both ways about three axes through their
// middle and registered again, and what explains them best by their noise is kept; from there once more.
#pragma once

#include "fsw/pose/evidence.hpp"
#include "fsw/pose/register.hpp"

namespace lasso {

constexpr double kCleanCost = 1.2;  // below it the returns are explained as the noise allows

class Sway {
 public:
  // `H`: information of the pose, kept with it.
  void begin(const Pose& T_target_sensor, const Mat6& H);
  // At most one registration on all returns; adds its work. False when it was the last one.
  bool step(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);

  const Pose& T_target_sensor() const { return best_; }
  const Mat6& H() const { return H_; }
  double cost() const { return cost_; }  // mean_cost of it

 private:
  void weigh(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);
  void try_from(const Mission& mission, const Pose& start, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);
  void end_round();

  Pose middle_, best_;
  Mat6 H_ = Mat6::Zero();
  double cost_ = 0;
  int next_ = 0;  // turn of the round; the first one is none
  int round_ = 0;
  bool moved_ = false;  // in this round
};

}  // namespace lasso
