#include "fsw/pose/recognition/robust_refinement.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

constexpr double kBetterCost = 0.97;  // of the cost so far: less is no other place
constexpr double kTurn_rad = 4 * kRadPerDeg;

// Turned about a place in the target's frame.
Pose turned(const Pose& T_target_sensor, int turn, const Vec3& middle) {
  Vec6 x = Vec6::Zero();
  x[turn / 2] = turn % 2 == 0 ? kTurn_rad : -kTurn_rad;
  x.tail<3>() = -x.head<3>().cross(middle);
  return step_pose(T_target_sensor, x);
}

// The returns of these regions.
void put_regions(const ScanSubset& subset, const bool (&wanted)[kRegions], Workspace& workspace) {
  workspace.points.clear();
  for (std::size_t i = 0; i < subset.hits.size(); ++i) {
    if (wanted[subset.regions[i]]) invariant(workspace.points.push_back(subset.hits[i]), "as many points as rays");
  }
}

}  // namespace

RegionCosts weigh_regions(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, Workspace& workspace) {
  RegionCosts region_costs;
  double cost = 0, explained_cost = 0, explained = 0, whole_cost = 0;
  for (std::size_t region = 0; region < kRegions; ++region) {
    bool wanted[kRegions] = {};
    wanted[region] = true;
    put_regions(subset, wanted, workspace);
    const auto returns = static_cast<double>(workspace.points.size());
    const double whole = clamp(cost_of_hits(mission, T_target_sensor, workspace), 0, kUnexplainedCost);
    const double each = clamp(whole, 0, kLostCost);
    whole_cost += returns * whole;
    cost += returns * each;
    region_costs.explained[region] = each < kLostCost;
    if (!region_costs.explained[region]) continue;
    explained_cost += returns * each;
    explained += returns;
  }
  if (!subset.hits.empty()) {
    region_costs.cost = cost / static_cast<double>(subset.hits.size());
    region_costs.whole_cost = whole_cost / static_cast<double>(subset.hits.size());
  }
  if (explained > 0) region_costs.explained_cost = explained_cost / explained;
  return region_costs;
}

void RobustRefiner::begin(const Pose& T_target_sensor, const Mat6& H, const RobustSettings& care) {
  *this = RobustRefiner();
  care_ = care;
  middle_ = best_ = T_target_sensor;
  H_ = H;
}

bool RobustRefiner::step(const Mission& mission, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work) {
  if (begun_) {
    try_next(mission, subset, workspace, work);
  } else {
    weigh(mission, best_, subset, workspace, work);
    region_costs_ = tried_region_costs_;
    begun_ = true;
  }
  return next_ <= care_.turns && !(region_costs_.cost < kCleanCost);
}

void RobustRefiner::try_next(const Mission& mission, const ScanSubset& subset, Workspace& workspace, std::uint32_t& work) {
  if (again_) {
    put_regions(subset, tried_region_costs_.explained, workspace);
    keep_if_better(try_from(mission, tried_, subset, workspace, work));
    again_ = false;
  } else if (next_ == 0) {
    put_points(subset, kSubsetHits, workspace);
    keep_if_better(try_from(mission, middle_, subset, workspace, work));
    again_ = care_.turns > 0;
  } else {
    put_points(subset, care_.turn_points, workspace);
    (void)try_from(mission, turned(middle_, next_ - 1, middle_ * subset.centroid), subset, workspace, work);
    again_ = tried_region_costs_.cost < care_.promising * region_costs_.cost;
  }
  if (!again_) ++next_;
}

void RobustRefiner::weigh(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, Workspace& workspace,
                          std::uint32_t& work) {
  tried_region_costs_ = weigh_regions(mission, T_target_sensor, subset, workspace);
  work += regions_work(subset.hits.size(), kRegions);
}

Mat6 RobustRefiner::try_from(const Mission& mission, const Pose& start, const ScanSubset& subset, Workspace& workspace,
                             std::uint32_t& work) {
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start, workspace);
  work += look_work(workspace.points.size(), solution.iterations);
  tried_ = solution.T_target_sensor;
  weigh(mission, tried_, subset, workspace, work);
  return solution.H;
}

void RobustRefiner::keep_if_better(const Mat6& H) {
  if (!(tried_region_costs_.cost < kBetterCost * region_costs_.cost)) return;
  best_ = tried_;
  H_ = H;
  region_costs_ = tried_region_costs_;
}

}  // namespace lasso
