// Is there a place near a pose that explains the returns better?
//
// A part of the target that is not where the model has it, but turned a little, attracts the pose until the other parts fit
// badly: a minimum, but not the best one. Where a pose leaves returns unexplained it is turned both ways about three axes through their
// middle and registered again, and what explains them best by their noise is kept. Where that is promising it is
// registered once more without the regions of the subset that it does not explain: what is left says where the rest of the target is.
#pragma once

#include "fsw/pose/recognition/scan_subset.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

constexpr double kCleanCost = 1.2;  // below it the returns are explained as the noise allows
constexpr double kLostCost = 6;     // of a region's returns: it is not explained, and how far from it the pose is says nothing

// What the returns of each region of the subset cost at a pose.
struct RegionCosts {
  double cost = kLostCost;               // mean_cost over all returns, where no region costs more than kLostCost
  double explained_cost = kLostCost;     // over the regions that cost less
  bool explained[kRegions] = {};         // these
  double whole_cost = kUnexplainedCost;  // mean_cost over all returns, where nothing is bounded
};
// One pass over the subset.
RegionCosts weigh_regions(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, Workspace& workspace);

struct RobustSettings {
  int turns;                // 6: both ways about three axes; 0: one registration from where the pose is
  std::size_t turn_points;  // returns that a turned pose is registered on first
  double promising;         // times the least cost so far: to be registered on all that it explains
};
constexpr RobustSettings kUsualRobust{6, 96, 1.1};
constexpr RobustSettings kGlanceRobust{0, 0, 0};
constexpr RobustSettings kThoroughRobust{6, kSubsetHits, 1.25};

class RobustRefiner {
 public:
  // `H`: information of the pose, kept with it.
  void begin(const Pose& T_target_sensor, const Mat6& H, const RobustSettings& care);
  // At most one registration on all returns, and a pass over them; adds its work. False when it was the last one.
  bool step(const Mission& mission, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work);

  const Pose& T_target_sensor() const { return best_; }
  const Mat6& H() const { return H_; }
  const RegionCosts& region_costs() const { return region_costs_; }  // of that pose

 private:
  void try_next(const Mission& mission, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work);
  void weigh(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work);
  // Registers workspace.points; its information.
  Mat6 try_from(const Mission& mission, const Pose& start, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work);
  void keep_if_better(const Mat6& H);

  RobustSettings care_ = kUsualRobust;
  Pose middle_, best_, tried_;
  Mat6 H_ = Mat6::Zero();
  RegionCosts region_costs_;        // of best_
  RegionCosts tried_region_costs_;  // of tried_
  int next_ = 0;                    // turn; the first one is none
  bool begun_ = false;
  bool again_ = false;  // tried_, on what it explains
};

}  // namespace lasso
