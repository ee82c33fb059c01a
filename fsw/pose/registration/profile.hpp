// The profile of a registration's cost along one axis of the pose: what its hits cost at best where the place along the axis is given and
// all else is free. Normal equations know only the surfaces that the rays meet now. Where rays pass an edge, their minimum is not that of
// the cost, and Gauss-Newton steps lead away from it: the roll of a nearly round body drifts by degrees. The profile compares costs.
//
// Costs are those of all returns (bounded_cost), squared sigmas of the assumed noise: a difference is twice the logarithm of a likelihood
// ratio. Axes are unit vectors over (rotation * radius, translation), target axes; lengths along them are metres at the model's radius.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/registration/registration.hpp"

namespace lasso {

struct CostedPose {
  Pose T_target_sensor;
  double cost = 0;
};

class Profile {
 public:
  // `usable` is that of the registration: its number of returns.
  Profile(const Mission& mission, const Vec6& axis, double usable, Workspace& workspace);

  // How far a step of (rotation, translation) goes along the axis.
  double along_m(const Vec6& step) const;

  // One pass over all points, nothing solved.
  CostedPose cost_at(const Pose& T_target_sensor);

  // The pose a step along the axis from here, fitted to the hits by `draws` passes with the axis held, and its cost: one pass more. The
  // first pass looks for what each ray meets along its whole gate. The fit moves the pose by little: later ones ask the surface met last
  // first.
  CostedPose draw_at(const Pose& T_target_sensor, double step_m, int draws);

  // Is the cost higher by `least`, so far off along the axis, either way? At most two passes.
  bool rises(const CostedPose& from, double way_m, double least);

  // A local minimum along the axis: steps that are doubled while they lower the cost, as far as half of the radius, then halved twice.
  // The first one is at least a 100th of the radius long: then at most 20 passes.
  CostedPose descend(const CostedPose& from, double first_step_m);

 private:
  bool try_step(double step_m, CostedPose& lowest);
  double double_steps(double step_m, CostedPose& lowest);

  const Mission& mission_;
  Workspace& workspace_;
  Vec6 axis_;
  Vec6 step_per_m_;  // of (rotation, translation)
  double usable_;
};

// Moves `hits` along the axis to where they cost least, if that is less by more than one return may cost. From the
// registration or from the prediction fitted to the hits, whichever costs less: one of both often lies beside a minimum that the other is
// in. Where the cost is higher by kRise, that of four returns, a step of `first_step_m` off, either way, it is taken for a minimum. The
// pose stays where the hits have no solution at the other place. Why it stopped stays as it was. Bound: 27 passes over all points.
constexpr double kRise = 4 * kMostOfAReturn;  // of a minimum's cost
struct Minimised {
  double registered_cost = 0;  // where `hits` were
  bool moved = false;
};
Minimised minimise_along(const Mission& mission, const Vec6& axis, double first_step_m, const Pose& predicted_T_target_sensor,
                         Workspace& workspace, HitSolution& hits);

}  // namespace lasso
