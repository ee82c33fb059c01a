#include "fsw/pose/registration/weak_axis.hpp"

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/minima.hpp"
#include "fsw/pose/registration/profile.hpp"
#include "fsw/pose/scan/path_pose.hpp"

namespace lasso {
namespace {

constexpr double kSigmas = 5;         // a valid pose is not farther off than so many of its own
constexpr double kCertain = 0.002;    // of the radius
constexpr double kLongestStep = 0.1;  // of the radius: a first step of a profile; parts that fix an axis are no wider

bool has_axes(const HitSolution& solution) {
  return solution.stop == StopReason::kConverged || solution.stop == StopReason::kIterationLimit;
}

// The least certain axis that the hits observe at all. Unobservable ones say so themselves: a rod's place along itself
// hides nothing of its roll, which comes next. (One at least is seen where there are hits.)
struct WeakAxis {
  Vec6 axis;
  double sigma_m = 0;
};

// Not compiled into its caller, where its matrices would add to the stack of the profile.
[[gnu::noinline]] void find_axis(const Mission& mission, const HitSolution& hits, WeakAxis& weak) {
  Directions unobservable;
  const Mat6 covariance = covariance_of_hits(mission.radius_m, hits.H, 1, unobservable);
  const Eigen6 eigen = axes_at_radius(covariance, mission.radius_m);
  const int least_certain = 5 - std::min(unobservable.count, 5);
  weak.axis = eigen.vectors.col(least_certain);
  weak.sigma_m = square_root(eigen.values[least_certain]);
}

bool is_certain(const Mission& mission, const WeakAxis& weak) { return weak.sigma_m < kCertain * mission.radius_m; }

// Is the pose more than five sigmas of the axis from the prediction, along it? Where rays have met the wrong surface, many of them keep it
// there, and it is sure of itself.
bool is_far(const Mission& mission, const Pose& predicted, const Pose& pose, const WeakAxis& weak) {
  const Vec6 way_m = radius_scale(mission.radius_m).cwiseProduct(way_between(pose, predicted));
  const double sigmas = weak.axis.dot(way_m) / weak.sigma_m;
  return sigmas * sigmas > kSigmas * kSigmas;
}

bool is_looked_at(const Mission& mission, const StartPoint& start, const Pose& predicted, const Pose& pose, const WeakAxis& weak) {
  if (!is_certain(mission, weak)) return true;
  return start.tracked && is_far(mission, predicted, pose, weak);
}

// The least way, of those doubled from five sigmas on, at which the cost has risen; the model's radius, or more, where there is none.
double rising_way_m(Profile& profile, const CostedPose& from, double radius_m, double sigma_m, double scale) {
  double way_m = kSigmas * sigma_m;
  while (way_m < radius_m && !profile.rises(from, way_m, kRise * scale)) way_m *= 2;
  return way_m;
}

// The nearest to the prediction of the minima, and what is not known where there are several.
void look_for_others(const Mission& mission, const WeakAxis& weak, const Minimised& along, const Pose& predicted, Workspace& workspace,
                     HitSolution& hits) {
  Profile profile(mission, weak.axis, hits.usable, workspace);
  const CostedPose from = along.moved ? profile.cost_at(hits.T_target_sensor) : CostedPose{hits.T_target_sensor, along.registered_cost};
  const Minima minima = find_minima(mission, from, weak.sigma_m, predicted, profile);
  if (minima.is_elsewhere) (void)move_hits(mission, minima.T_target_sensor, workspace, hits);
  hits.others_apart = minima.are_apart;
  hits.axis = weak.axis;
  hits.spread = minima.spread;
}

}  // namespace

void minimise_weak_axis(const Mission& mission, const StartPoint& start, Workspace& workspace, HitSolution& hits) {
  if (!has_axes(hits) || explained_share(hits) < mission.parameters.inlier_share_min) return;
  WeakAxis weak;
  find_axis(mission, hits, weak);
  const Pose predicted = inverse(start.T_sensor_target);
  if (!is_looked_at(mission, start, predicted, hits.T_target_sensor, weak)) return;
  const double first_step_m = clamp(kSigmas * weak.sigma_m, kSigmas * kCertain * mission.radius_m, kLongestStep * mission.radius_m);
  const Minimised along = minimise_along(mission, weak.axis, first_step_m, predicted, workspace, hits);
  if (!is_certain(mission, weak)) look_for_others(mission, weak, along, predicted, workspace, hits);
}

void widen_weak_axes(const Mission& mission, const HitSolution& hits, double scale, Workspace& workspace, Mat6& covariance,
                     Directions& unobservable) {
  const Eigen6 eigen = axes_at_radius(covariance, mission.radius_m);
  if (square_root(eigen.values[5]) < kCertain * mission.radius_m) return;
  const double anywhere_m = kUnobservableSigma * mission.radius_m;
  const CostedPose here = Profile(mission, Vec6::Zero(), hits.usable, workspace).cost_at(hits.T_target_sensor);
  for (int i = 5; i >= 0; --i) {
    const double sigma_m = square_root(eigen.values[i]);
    if (sigma_m < kCertain * mission.radius_m) return;
    if (kSigmas * sigma_m > mission.radius_m) continue;
    const Vec6 axis = eigen.vectors.col(i);
    Profile profile(mission, axis, hits.usable, workspace);
    const double way_m = rising_way_m(profile, here, mission.radius_m, sigma_m, scale);
    const bool is_seen = way_m < mission.radius_m;
    if (!is_seen) unobservable.vectors.col(unobservable.count++) = axis;
    const double held_m = is_seen ? way_m / kSigmas : anywhere_m;
    const Vec6 row = axis.cwiseQuotient(radius_scale(mission.radius_m));
    covariance += (held_m * held_m - eigen.values[i]) * row * row.transpose();
  }
}

void add_others(const HitSolution& hits, Mat6& covariance, Directions& unobservable) {
  covariance += hits.spread;
  if (!hits.others_apart) return;
  if (unobservable.count < 6) unobservable.vectors.col(unobservable.count++) = hits.axis;
}

}  // namespace lasso
