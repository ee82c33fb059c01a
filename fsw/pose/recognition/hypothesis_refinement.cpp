#include "fsw/pose/recognition/hypothesis_refinement.hpp"

#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

constexpr double kSettled = 0.02;  // disagreement below which nothing better is looked for

Settled measured(const Mission& mission, const Evidence& evidence, const HitSolution& solution, double limit, std::size_t points,
                 std::uint32_t& work) {
  Settled settled{solution, measure_fit(mission, solution.T_target_sensor, evidence, limit)};
  work += look_work(points, solution.iterations) + fit_work(settled.fit);
  return settled;
}

}  // namespace

Settled sketch(const Mission& mission, const Evidence& evidence, const SketchStart& start, double limit, Workspace& workspace,
               std::uint32_t& work) {
  put_points(evidence, kSketchPoints, workspace);
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start.T_target_sensor, workspace);
  Settled settled = measured(mission, evidence, solution, limit, workspace.points.size(), work);
  if (!(settled.fit.score() > poor_beyond(start.fit.score()))) return settled;
  work += weigh_work(workspace.points.size());
  return {weigh_hits(mission, start.T_target_sensor, workspace), start.fit};
}

void Settler::begin(const Pose& rough, const Pose& start) {
  attempt_ = Attempt::kFirst;
  rough_ = rough;
  start_ = start;
}

void Settler::look(const Mission& mission, const Evidence& evidence, RegisterLook which, Workspace& workspace, std::uint32_t& work) {
  const bool first = attempt_ == Attempt::kFirst;
  const double limit = first ? kAnyScore : best_.fit.score();
  put_points(evidence, kEvidenceHits, workspace);
  const HitSolution solution = register_look(mission, which, rough_, workspace);
  const Settled settled = measured(mission, evidence, solution, limit, workspace.points.size(), work);
  if (first || settled.fit.score() < limit) best_ = settled;
}

bool Settler::step(const Mission& mission, const Evidence& evidence, double limit, Workspace& workspace, std::uint32_t& work) {
  switch (attempt_) {
    case Attempt::kFirst:
      look(mission, evidence, RegisterLook::kFirst, workspace, work);
      attempt_ = Attempt::kSecondLook;
      break;
    case Attempt::kSecondLook:
      look(mission, evidence, RegisterLook::kSecond, workspace, work);
      attempt_ = Attempt::kDraw;
      break;
    case Attempt::kDraw:
      put_points(evidence, kEvidenceHits, workspace);
      rough_ = pull_in(mission, start_, workspace);
      work += pull_work(workspace.points.size()) + draw_work(workspace.points.size());
      attempt_ = Attempt::kLast;
      return true;
    default:
      look(mission, evidence, RegisterLook::kFirst, workspace, work);
      return false;
  }
  return best_.fit.disagreement() > kSettled && best_.fit.score() < limit;
}

std::uint32_t fit_work(const Fit& fit) {
  const auto hits = static_cast<std::size_t>(static_cast<std::uint32_t>(fit.hits));
  return fit.walks < hits ? fit_work(fit.walks, 0) : fit_work(hits, fit.walks - hits);
}

}  // namespace lasso
