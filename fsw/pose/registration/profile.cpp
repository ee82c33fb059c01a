#include "fsw/pose/registration/profile.hpp"

#include "fsw/pose/registration/gauss_newton.hpp"
#include "fsw/pose/registration/observability.hpp"

namespace lasso {
namespace {

constexpr double kFarthest = 0.5;  // of the radius
constexpr int kHalvings = 2;
constexpr int kPredictionDraws = 2;

}  // namespace

Profile::Profile(const Mission& mission, const Vec6& axis, double usable, Workspace& workspace)
    : mission_(mission),
      workspace_(workspace),
      axis_(axis),
      step_per_m_(axis.cwiseQuotient(radius_scale(mission.radius_m))),
      usable_(usable) {}

double Profile::along_m(const Vec6& step) const { return axis_.dot(radius_scale(mission_.radius_m).cwiseProduct(step)); }

CostedPose Profile::cost_at(const Pose& T_target_sensor) {
  return {T_target_sensor, bounded_cost(mission_, T_target_sensor, usable_, Lookup::kWalk, workspace_)};
}

CostedPose Profile::draw_at(const Pose& T_target_sensor, double step_m, int draws) {
  Pose drawn = step_pose(T_target_sensor, step_m * step_per_m_);
  for (int i = 0; i < draws; ++i) take_held_pass(mission_, axis_, i == 0 ? Lookup::kWalk : Lookup::kLast, workspace_, drawn);
  return {drawn, bounded_cost(mission_, drawn, usable_, Lookup::kLast, workspace_)};
}

bool Profile::rises(const CostedPose& from, double way_m, double least) {
  for (const double step_m : {way_m, -way_m}) {
    if (!(cost_at(step_pose(from.T_target_sensor, step_m * step_per_m_)).cost >= from.cost + least)) return false;
  }
  return true;
}

bool Profile::try_step(double step_m, CostedPose& lowest) {
  const CostedPose next = draw_at(lowest.T_target_sensor, step_m, 1);
  if (!(next.cost < lowest.cost)) return false;
  lowest = next;
  return true;
}

// The last step of those that lower the cost.
double Profile::double_steps(double step_m, CostedPose& lowest) {
  const double farthest_m = kFarthest * mission_.radius_m;
  double way_m = step_m;
  while ((way_m + 2 * step_m) * (way_m + 2 * step_m) <= farthest_m * farthest_m && try_step(2 * step_m, lowest)) {
    step_m *= 2;
    way_m += step_m;
  }
  return step_m;
}

CostedPose Profile::descend(const CostedPose& from, double first_step_m) {
  CostedPose lowest = from;
  double step_m = first_step_m;
  if (try_step(step_m, lowest)) {
    step_m = double_steps(step_m, lowest);
  } else if (try_step(-step_m, lowest)) {
    step_m = double_steps(-step_m, lowest);
  }
  for (int i = 0; i < kHalvings; ++i) {
    step_m *= 0.5;
    if (!try_step(step_m, lowest)) (void)try_step(-step_m, lowest);
  }
  return lowest;
}

Minimised minimise_along(const Mission& mission, const Vec6& axis, double first_step_m, const Pose& predicted, Workspace& workspace,
                         HitSolution& hits) {
  Profile profile(mission, axis, hits.usable, workspace);
  const CostedPose registered = profile.cost_at(hits.T_target_sensor);
  const CostedPose other = profile.draw_at(predicted, 0, kPredictionDraws);
  CostedPose lowest = other.cost < registered.cost ? other : registered;
  if (!profile.rises(lowest, first_step_m, kRise)) lowest = profile.descend(lowest, first_step_m);
  if (!(lowest.cost < registered.cost - kMostOfAReturn)) return {registered.cost, false};
  return {registered.cost, move_hits(mission, lowest.T_target_sensor, workspace, hits)};
}

}  // namespace lasso
