#include "fsw/pose/sway.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/settle.hpp"

namespace lasso {
namespace {

constexpr double kBetterCost = 0.97;  // of the cost so far: less is no other place
constexpr double kTurn_rad = 4 * kRadPerDeg;
constexpr int kTurns = 6;  // both ways about three axes
constexpr int kRounds = 2;

// Turned about a place in the target's frame.
Pose turned(const Pose& T_target_sensor, int turn, const Vec3& middle) {
  Vec6 x = Vec6::Zero();
  x[turn / 2] = turn % 2 == 0 ? kTurn_rad : -kTurn_rad;
  x.tail<3>() = -x.head<3>().cross(middle);
  return step_pose(T_target_sensor, x);
}

}  // namespace

void Sway::begin(const Pose& T_target_sensor, const Mat6& H) {
  *this = Sway();
  middle_ = best_ = T_target_sensor;
  H_ = H;
}

bool Sway::step(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  if (round_ == 0 && next_ == 0) {
    weigh(mission, evidence, workspace, work);
    if (cost_ < kCleanCost) return false;
    try_from(mission, middle_, evidence, workspace, work);
  } else {
    try_from(mission, turned(middle_, next_ - 1, middle_ * evidence.centroid), evidence, workspace, work);
  }
  if (++next_ > kTurns) end_round();
  return round_ < kRounds;
}

void Sway::weigh(const Mission& mission, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  put_points(evidence, kEvidenceHits, workspace);
  cost_ = mean_cost(weigh_hits(mission, best_, workspace));
  work += weigh_work(workspace);
}

void Sway::try_from(const Mission& mission, const Pose& start, const Evidence& evidence, Workspace& workspace, std::uint32_t& work) {
  put_points(evidence, kEvidenceHits, workspace);
  const HitSolution solution = register_look(mission, RegisterLook::kFirst, start, workspace);
  const double cost = mean_cost(weigh_hits(mission, solution.T_target_sensor, workspace));
  work += (1u + solution.iterations) * weigh_work(workspace);
  if (!(cost < kBetterCost * cost_)) return;
  best_ = solution.T_target_sensor;
  H_ = solution.H;
  cost_ = cost;
  moved_ = true;
}

// Another round only where this one has found another place.
void Sway::end_round() {
  round_ = moved_ ? round_ + 1 : kRounds;
  next_ = 1;
  moved_ = false;
  middle_ = best_;
}

}  // namespace lasso
