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
void put_regions(const Evidence& evidence, const bool (&wanted)[kRegions], Workspace& workspace) {
  workspace.points.clear();
  for (std::size_t i = 0; i < evidence.hits.size(); ++i) {
    if (wanted[evidence.regions[i]]) invariant(workspace.points.push_back(evidence.hits[i]), "as many points as rays");
  }
}

}  // namespace

Standing weigh_regions(const Mission& mission, const Pose& T_target_sensor, const Evidence& evidence, Workspace& workspace) {
  Standing standing;
  double cost = 0, explained_cost = 0, explained = 0, whole_cost = 0;
  for (std::size_t region = 0; region < kRegions; ++region) {
    bool wanted[kRegions] = {};
    wanted[region] = true;
    put_regions(evidence, wanted, workspace);
    const auto returns = static_cast<double>(workspace.points.size());
    const double whole = clamp(cost_of_hits(mission, T_target_sensor, workspace), 0, kUnexplainedCost);
    const double each = clamp(whole, 0, kLostCost);
    whole_cost += returns * whole;
    cost += returns * each;
    standing.explained[region] = each < kLostCost;
    if (!standing.explained[region]) continue;
    explained_cost += returns * each;
    explained += returns;
  }
  if (!evidence.hits.empty()) {
    standing.cost = cost / static_cast<double>(evidence.hits.size());
    standing.whole_cost = whole_cost / static_cast<double>(evidence.hits.size());
  }
  if (explained > 0) standing.explained_cost = explained_cost / explained;
  return standing;
}

void Sway::begin(const Pose& T_target_sensor, const Mat6& H, const SwayCare& care) {
  *this = Sway();
  care_ = care;
  middle_ = best_ = T_target_sensor;
  H_ = H;
}

bool Sway::step(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  if (begun_) {
    try_next(mission, evidence, workspace, work);
  } else {
    weigh(mission, best_, evidence, workspace, work);
    standing_ = tried_standing_;
    begun_ = true;
  }
  return next_ <= care_.turns && !(standing_.cost < kCleanCost);
}

void Sway::try_next(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  if (again_) {
    put_regions(evidence, tried_standing_.explained, workspace);
    keep_if_better(try_from(mission, tried_, evidence, workspace, work));
    again_ = false;
  } else if (next_ == 0) {
    put_points(evidence, kEvidenceHits, workspace);
    keep_if_better(try_from(mission, middle_, evidence, workspace, work));
    again_ = care_.turns > 0;
  } else {
    put_points(evidence, care_.turn_points, workspace);
    (void)try_from(mission, turned(middle_, next_ - 1, middle_ * evidence.centroid), evidence, workspace, work);
    again_ = tried_standing_.cost < care_.promising * standing_.cost;
  }
  if (!again_) ++next_;
}

void Sway::weigh(const Mission& mission, const Pose& T_target_sensor, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  tried_standing_ = weigh_regions(mission, T_target_sensor, evidence, workspace);
  work += regions_work(evidence.hits.size(), kRegions);
}

Mat6 Sway::try_from(const Mission& mission, const Pose& start, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start, workspace);
  work += look_work(workspace.points.size(), solution.iterations);
  tried_ = solution.T_target_sensor;
  weigh(mission, tried_, evidence, workspace, work);
  return solution.H;
}

void Sway::keep_if_better(const Mat6& H) {
  if (!(tried_standing_.cost < kBetterCost * standing_.cost)) return;
  best_ = tried_;
  H_ = H;
  standing_ = tried_standing_;
}

}  // namespace lasso
