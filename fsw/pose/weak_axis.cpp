#include "fsw/pose/weak_axis.hpp"

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/gauss_newton.hpp"
#include "fsw/pose/path_pose.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kSigmas = 5;  // a valid pose is not farther off than so many of its own
constexpr double kSquare = kSigmas * kSigmas;
constexpr double kLeastRise = 0.64;        // of the cost that the covariance promises: a sigma may be short by a fifth
constexpr double kCertain = 0.002;         // of the radius
constexpr double kHopeless = 4 * kSquare;  // a trial that costs more by this is not registered
constexpr double kMixed = 0.25;            // variance of a mixture of two equal parts about its mean, of their squared distance
constexpr double kBeyond = 1.25;           // of the way to a rival: it is found again although the pose has moved
constexpr double kFarthest = 3.15;         // of the radius: half a turn; a prior that knows less says nothing
constexpr int kTrialPasses = 2;
constexpr PassKind kTrialPass{4, Lookup::kWalk};
constexpr PassKind kTrialCost{2, Lookup::kWalk};

double length_m(const Mission& mission, const Vec6& step) {
  return square_root(step.cwiseProduct(radius_scale(mission.radius_m)).squaredNorm());
}

double larger(double a, double b) { return a > b ? a : b; }

// The step of step_pose that leads from one to the other, with the rotation vector for its rotation.
Vec6 step_between(const Pose& from, const Pose& to) {
  const Quat turn = normalized(to.q * from.q.conjugate());
  Vec6 step;
  step << log_so3(turn), to.p - rotate(turn, from.p);
  return step;
}

bool has_axes(const HitSolution& solution) {
  return solution.stop == StopReason::kConverged || solution.stop == StopReason::kIterationLimit;
}

// The least certain axis of a registration's hits that they see at all; target axes. Unseen ones say themselves that nothing is known along
// them: a rod's place along itself hides nothing of its roll, which comes next. (One at least is seen where there are hits.)
struct WeakAxis {
  Mat6 covariance, information;
  Vec6 axis;
  double sigma_m = 0;
};

// This and what follows marked so is not compiled into its caller, where its matrices would add to the stack of the registrations.
[[gnu::noinline]] void find_axis(const Mission& mission, const HitSolution& near, WeakAxis& weak) {
  Directions unseen;
  weak.covariance = covariance_of_hits(mission.radius_m, near.H, 1, unseen);
  weak.information = near.H;
  const Eigen6 eigen = axes_at_radius(weak.covariance, mission.radius_m);
  const int least_certain = 5 - std::min(unseen.count, 5);
  weak.axis = eigen.vectors.col(least_certain);
  weak.sigma_m = square_root(eigen.values[least_certain]);
}

double kernel_width_m(const Mission& mission, const Workspace& workspace) {
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  return mission.parameters.kernel_width * square_root(N::to_double(s.reference_variance));
}

[[gnu::noinline]] double reach_of(const Mission& mission, const PriorPose& prior, const HitSolution& near, const WeakAxis& weak,
                                  const Workspace& workspace) {
  const double prior_m = kSigmas * square_root(weak.axis.dot(at_radius(prior.covariance, mission.radius_m) * weak.axis));
  const double loose_m = prior_m > mission.parameters.gate_first_m ? prior_m : 0;
  const double unexplained_m = explained_share(near) < kExplainedShare ? kernel_width_m(mission, workspace) : 0;
  return clamp(larger(larger(loose_m, prior.rival_m), unexplained_m), 0.0, kFarthest * mission.radius_m);
}

struct Trial {
  Pose T_target_sensor;
  double cost = 0;  // mean_cost
};
using Trials = FixedVector<Trial, kWeakAxisKept>;

[[gnu::noinline]] void draw(const Mission& mission, double longest_m, Workspace& workspace, Pose& T_target_sensor) {
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Descent descent{longest_m};
  for (int i = 0; i < kTrialPasses; ++i) (void)take_pass(mission, s, kTrialPass, descent, workspace, T_target_sensor);
}

Trial try_from(const Mission& mission, const Pose& place, double longest_m, Workspace& workspace) {
  Trial trial{place};
  draw(mission, longest_m, workspace, trial.T_target_sensor);
  trial.cost = cost_of_hits(mission, trial.T_target_sensor, workspace, kTrialCost);
  return trial;
}

// Keeps the trials with the lowest costs, in their order.
void keep_lowest(const Trial& trial, Trials& kept) {
  if (kept.full() && !(trial.cost < kept[kWeakAxisKept - 1].cost)) return;
  if (kept.full()) kept.shrink(kWeakAxisKept - 1);
  invariant(kept.push_back(trial), "room for a trial");
  for (std::size_t i = kept.size() - 1; i > 0 && kept[i].cost < kept[i - 1].cost; --i) {
    const Trial lower = kept[i];
    kept[i] = kept[i - 1];
    kept[i - 1] = lower;
  }
}

// Is it another pose than the registration's, by its own covariance?
bool is_apart(const WeakAxis& weak, const Vec6& step) { return step.dot(weak.information * step) > kSquare; }

void try_all(const Mission& mission, const HitSolution& near, const WeakAxis& weak, double reach_m, Workspace& workspace, Trials& kept) {
  const double step_m = larger(reach_m / kWeakAxisSteps, kSigmas * weak.sigma_m);
  if (step_m > reach_m) return;
  const double hopeless = cost_of_hits(mission, near.T_target_sensor, workspace, kTrialCost) + kHopeless / near.usable;
  const Vec6 step = step_m * weak.axis.cwiseQuotient(radius_scale(mission.radius_m));
  for (int k = 1; k <= kWeakAxisSteps && k * step_m <= reach_m; ++k) {
    for (const double way : {k, -k}) {
      const Trial trial = try_from(mission, step_pose(near.T_target_sensor, way * step), step_m, workspace);
      if (trial.cost < hopeless && is_apart(weak, step_between(near.T_target_sensor, trial.T_target_sensor))) keep_lowest(trial, kept);
    }
  }
}

// Within five sigmas of prior and registration. What has no inverse excludes nothing.
bool is_likely(const PriorPose& prior, const WeakAxis& weak, const Pose& T_target_sensor) {
  const Vec6 step = step_between(prior.T_target_sensor, T_target_sensor);
  Mat6 information = Mat6::Zero();
  static_cast<void>(invert6(prior.covariance + weak.covariance, information));
  return step.dot(information * step) <= kSquare;
}

// Within 25 squared sigmas both the one and the other are believed.
void add_rival(const Mission& mission, const Pose& rival, LineSearch& search) {
  invariant(search.rivals.push_back(rival), "room for a rival");
  search.rival_m = larger(search.rival_m, kBeyond * length_m(mission, step_between(search.best.T_target_sensor, rival)));
}

void move_to(const Mission& mission, const HitSolution& other, double rise, LineSearch& search) {
  const Pose before = search.best.T_target_sensor;
  search.best = other;
  if (rise > -kSquare) return add_rival(mission, before, search);
  search.rivals.clear();
  search.rival_m = 0;
}

// Into `search`, what the minimum beside its best pose is.
[[gnu::noinline]] void weigh(const Mission& mission, const PriorPose& prior, const WeakAxis& weak, const HitSolution& other,
                             LineSearch& search) {
  const Vec6 step = step_between(search.best.T_target_sensor, other.T_target_sensor);
  if (!is_apart(weak, step)) return;
  const double rise = (mean_cost(other) - mean_cost(search.best)) * search.best.usable;
  if (!is_likely(prior, weak, other.T_target_sensor) && length_m(mission, step) > prior.rival_m) {
    search.contradicted = search.contradicted || rise < -kSquare;
  } else if (rise < 0) {
    move_to(mission, other, rise, search);
  } else if (rise < kSquare) {
    add_rival(mission, other.T_target_sensor, search);
  }
}

// Five of its sigmas off along the axis, either way: is the cost higher by `least`?
bool rises(const Mission& mission, const HitSolution& hits, const Vec6& axis, double way_m, double least, Workspace& workspace) {
  const Vec6 step = way_m * axis.cwiseQuotient(radius_scale(mission.radius_m));
  for (const double sign : {1, -1}) {
    const double cost = cost_of_hits(mission, step_pose(hits.T_target_sensor, sign * step), workspace);
    if (!((cost - mean_cost(hits)) * hits.usable >= least)) return false;
  }
  return true;
}

// The least way, of those doubled from five sigmas on, at which the cost has risen; the model's radius, or more, where there is none.
double rising_way_m(const Mission& mission, const HitSolution& hits, const Vec6& axis, double sigma_m, double scale, Workspace& workspace) {
  double way_m = kSigmas * sigma_m;
  while (way_m < mission.radius_m && !rises(mission, hits, axis, way_m, kLeastRise * kSquare * scale, workspace)) way_m *= 2;
  return way_m;
}

}  // namespace

void search_weak_axis(const Mission& mission, const PriorPose& prior, Workspace& workspace, LineSearch& search) {
  if (!has_axes(search.best) || prior.covariance.isZero(0.0)) return;
  WeakAxis weak;
  find_axis(mission, search.best, weak);
  Trials kept;
  try_all(mission, search.best, weak, reach_of(mission, prior, search.best, weak, workspace), workspace, kept);
  for (const Trial& trial : kept) weigh(mission, prior, weak, register_first(mission, trial.T_target_sensor, workspace), search);
}

Mat6 with_rivals(const LineSearch& search, const Mat6& covariance) {
  Mat6 whole = covariance;
  for (const Pose& rival : search.rivals) {
    const Vec6 step = step_between(search.best.T_target_sensor, rival);
    whole += kMixed * step * step.transpose();
  }
  return whole;
}

void widen_weak_axes(const Mission& mission, const HitSolution& hits, double scale, Workspace& workspace, Mat6& covariance,
                     Directions& unseen) {
  const Eigen6 eigen = axes_at_radius(covariance, mission.radius_m);
  const double anywhere_m = kUnseenSigma * mission.radius_m;
  for (int i = 5; i >= 0; --i) {
    const double sigma_m = square_root(eigen.values[i]);
    if (sigma_m < kCertain * mission.radius_m) return;
    if (kSigmas * sigma_m > mission.radius_m) continue;
    const Vec6 axis = eigen.vectors.col(i);
    const double way_m = rising_way_m(mission, hits, axis, sigma_m, scale, workspace);
    const bool is_seen = way_m < mission.radius_m;
    if (!is_seen) unseen.vectors.col(unseen.count++) = axis;
    const double held_m = is_seen ? way_m / kSigmas : anywhere_m;
    const Vec6 row = axis.cwiseQuotient(radius_scale(mission.radius_m));
    covariance += (held_m * held_m - eigen.values[i]) * row * row.transpose();
  }
}

}  // namespace lasso
