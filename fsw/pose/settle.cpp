#include "fsw/pose/settle.hpp"

namespace lasso {
namespace {

constexpr std::size_t kSketchPoints = 128;
constexpr double kSettled = 0.02;  // disagreement below which nothing better is looked for
// Look-ups of one point, by what its instructions are worth on a 603e.
constexpr std::uint32_t kFitCost = 18;
constexpr std::uint32_t kPassCost = 12;
constexpr std::uint32_t kPullCost = 32;  // 8 passes on distances
constexpr std::uint32_t kRayPulls = 4;

std::uint32_t points_of(const Workspace& workspace) { return static_cast<std::uint32_t>(workspace.points.size()); }
Settled measured(const Mission& mission, const Evidence& evidence, const HitSolution& solution, double limit, std::uint32_t points,
                 std::uint32_t& work) {
  Settled settled{solution, measure_fit(mission, solution.T_target_sensor, evidence, limit)};
  work += kPassCost * points * solution.iterations + fit_work(settled.fit);
  return settled;
}

}  // namespace

std::uint32_t fit_work(const Fit& fit) { return kFitCost * fit.walks; }
std::uint32_t pull_work(const Workspace& workspace) { return kPullCost * points_of(workspace); }
std::uint32_t draw_work(const Workspace& workspace) { return kRayPulls * weigh_work(workspace); }
std::uint32_t weigh_work(const Workspace& workspace) { return kPassCost * points_of(workspace); }

Settled sketch(const Mission& mission, const Evidence& evidence, const SketchStart& start, double limit, Workspace& workspace,
               std::uint32_t& work) {
  put_points(evidence, kSketchPoints, workspace);
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start.T_target_sensor, workspace);
  Settled settled = measured(mission, evidence, solution, limit, points_of(workspace), work);
  if (!(settled.fit.score() > poor_beyond(start.fit.score()))) return settled;
  work += weigh_work(workspace);
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
  const Settled settled = measured(mission, evidence, solution, limit, points_of(workspace), work);
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
      work += pull_work(workspace) + draw_work(workspace);
      attempt_ = Attempt::kLast;
      return true;
    default:
      look(mission, evidence, RegisterLook::kFirst, workspace, work);
      return false;
  }
  return best_.fit.disagreement() > kSettled && best_.fit.score() < limit;
}

}  // namespace lasso
