// Is there a place near a pose that explains the returns better?
//
// A part of the target that is not where the model has it, but turned a little, pulls the pose towards itself until the other parts fit
// badly: a minimum, but not the best one. Where a pose leaves returns unexplained it is turned both ways about three axes through their
// middle and registered again, and what explains them best by their noise is kept. Where that is promising it is
// registered once more without the regions of the evidence that it does not explain: what is left says where the rest of the target is.
#pragma once

#include "fsw/pose/recognition/scan_subset.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

constexpr double kCleanCost = 1.2;  // below it the returns are explained as the noise allows
constexpr double kLostCost = 6;     // of a region's returns: it is not explained, and how far from it the pose is says nothing

// What a pose makes of the evidence, region by region.
struct Standing {
  double cost = kLostCost;               // mean_cost over all returns, where no region costs more than kLostCost
  double explained_cost = kLostCost;     // over the regions that cost less
  bool explained[kRegions] = {};         // these
  double whole_cost = kUnexplainedCost;  // mean_cost over all returns, where nothing is bounded
};
// One pass over the evidence.
Standing weigh_regions(const Mission& mission, const Pose& T_target_sensor, const Evidence& evidence, Workspace& workspace);

struct SwayCare {
  int turns;                // 6: both ways about three axes; 0: one registration from where the pose is
  std::size_t turn_points;  // returns that a turned pose is registered on first
  double promising;         // times the least cost so far: to be registered on all that it explains
};
constexpr SwayCare kUsualSway{6, 96, 1.1};
constexpr SwayCare kGlanceSway{0, 0, 0};
constexpr SwayCare kThoroughSway{6, kEvidenceHits, 1.25};

class Sway {
 public:
  // `H`: information of the pose, kept with it.
  void begin(const Pose& T_target_sensor, const Mat6& H, const SwayCare& care);
  // At most one registration on all returns, and a pass over them; adds its work. False when it was the last one.
  bool step(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);

  const Pose& T_target_sensor() const { return best_; }
  const Mat6& H() const { return H_; }
  const Standing& standing() const { return standing_; }  // of that pose

 private:
  void try_next(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);
  void weigh(const Mission& mission, const Pose& T_target_sensor, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);
  // Registers workspace.points; its information.
  Mat6 try_from(const Mission& mission, const Pose& start, const Evidence& evidence, Workspace& workspace, std::uint32_t& work);
  void keep_if_better(const Mat6& H);

  SwayCare care_ = kUsualSway;
  Pose middle_, best_, tried_;
  Mat6 H_ = Mat6::Zero();
  Standing standing_;        // of best_
  Standing tried_standing_;  // of tried_
  int next_ = 0;             // turn; the first one is none
  bool begun_ = false;
  bool again_ = false;  // tried_, on what it explains
};

}  // namespace lasso
