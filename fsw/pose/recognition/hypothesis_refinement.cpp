#include "fsw/pose/recognition/hypothesis_refinement.hpp"

#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

constexpr double kRefined = 0.02;  // disagreement below which nothing better is looked for

RefinedHypothesis measured(const Mission& mission, const ScanSubset& subset, const HitSolution& solution, double limit, std::size_t points,
                           std::uint32_t& work) {
  RefinedHypothesis refined{solution, measure_score(mission, solution.T_target_sensor, subset, limit)};
  work += look_work(points, solution.iterations) + score_work(refined.fit);
  return refined;
}

}  // namespace

RefinedHypothesis refine_fast(const Mission& mission, const ScanSubset& subset, const FastRefineStart& start, double limit,
                              Workspace& workspace, std::uint32_t& work) {
  put_points(subset, kFastRefinePoints, workspace);
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start.T_target_sensor, workspace);
  RefinedHypothesis refined = measured(mission, subset, solution, limit, workspace.points.size(), work);
  if (!(refined.fit.score() > poor_beyond(start.fit.score()))) return refined;
  work += weigh_work(workspace.points.size());
  return {weigh_hits(mission, start.T_target_sensor, workspace), start.fit};
}

void HypothesisRefiner::begin(const Pose& rough, const Pose& start) {
  attempt_ = Attempt::kFirst;
  rough_ = rough;
  start_ = start;
}

void HypothesisRefiner::look(const Mission& mission, const ScanSubset& subset, RegisterLook which, Workspace& workspace,
                             std::uint32_t& work) {
  const bool first = attempt_ == Attempt::kFirst;
  const double limit = first ? kAnyScore : best_.fit.score();
  put_points(subset, kSubsetHits, workspace);
  const HitSolution solution = register_look(mission, which, rough_, workspace);
  const RefinedHypothesis refined = measured(mission, subset, solution, limit, workspace.points.size(), work);
  if (first || refined.fit.score() < limit) best_ = refined;
}

bool HypothesisRefiner::step(const Mission& mission, const ScanSubset& subset, double limit, Workspace& workspace, std::uint32_t& work) {
  switch (attempt_) {
    case Attempt::kFirst:
      look(mission, subset, RegisterLook::kFirst, workspace, work);
      attempt_ = Attempt::kSecondLook;
      break;
    case Attempt::kSecondLook:
      look(mission, subset, RegisterLook::kSecond, workspace, work);
      attempt_ = Attempt::kAlignOnRays;
      break;
    case Attempt::kAlignOnRays:
      put_points(subset, kSubsetHits, workspace);
      rough_ = align_on_both(mission, start_, workspace);
      work += distance_alignment_work(workspace.points.size()) + ray_alignment_work(workspace.points.size());
      attempt_ = Attempt::kLast;
      return true;
    default:
      look(mission, subset, RegisterLook::kFirst, workspace, work);
      return false;
  }
  return best_.fit.disagreement() > kRefined && best_.fit.score() < limit;
}

std::uint32_t score_work(const HypothesisScore& fit) {
  const auto hits = static_cast<std::size_t>(static_cast<std::uint32_t>(fit.hits));
  return fit.walks < hits ? score_work(fit.walks, 0) : score_work(hits, fit.walks - hits);
}

}  // namespace lasso
