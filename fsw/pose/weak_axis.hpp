// Tests of a registration along its least certain axes. Gauss-Newton knows only the surfaces that the rays meet now. A small part that was
// matched to another one, or a facet to the next, holds the pose at a wrong place, and the normal equations say that it is held there. So
// poses along such an axis are tried, and what they cost is compared.
//
// Axes are eigenvectors of the hits' covariance over (rotation * radius, translation), target axes. Lengths along them are metres at the
// model's radius. A cost is that of all returns (mean_cost times their number; of a trial the mean of half of them): squared sigmas. A
// difference is about twice the logarithm of a likelihood ratio where residuals are a few sigmas. It is not beyond 6 (see mean_cost).
#pragma once

#include "fsw/core/fixed_vector.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/register.hpp"
#include "fsw/pose/unseen.hpp"

namespace lasso {

// What is known of a pose before its scan is registered.
struct PriorPose {
  Pose T_target_sensor;
  Mat6 covariance = Mat6::Zero();  // target axes; zero: no other pose is looked for
  double rival_m = 0;              // LineSearch::rival_m of the scan before
};

constexpr int kWeakAxisSteps = FlightNumber::kLinePlaces;       // each way
constexpr std::size_t kWeakAxisKept = FlightNumber::kLineKept;  // poses of a line that are registered

struct LineSearch {
  HitSolution best;
  FixedVector<Pose, kWeakAxisKept> rivals;  // T_target_sensor of others that explain the scan as well
  double rival_m = 0;                       // how far off the farthest is, and a quarter more: to be looked for in the next scan, too
  bool contradicted = false;                // a pose that the prior excludes costs less, by 25 or more
};

// Line search along the least certain axis of `search.best`, a registration, that its hits see at all. Places are tried from five of its
// sigmas on, as far as five sigmas of the prior, if these exceed estimation.gate_first_m; as `prior.rival_m`; and as the kernel's width, if
// more than 1 % of the returns are unexplained; not farther than half a turn at the model's radius. From each place two passes are taken,
// and the poses with the two lowest costs are registered. One within five sigmas of the prior, or within `prior.rival_m`, takes the place
// of the best where it costs less, and is a rival where the costs differ by less than 25: five sigmas. Bound: of 2 * kWeakAxisSteps places
// kTrialPasses passes over a quarter of the points and one over half, and kWeakAxisKept times register_first.
void search_weak_axis(const Mission& mission, const PriorPose& prior, Workspace& workspace, LineSearch& search);

// The covariance with a quarter of the squared way to each rival. With one rival that is the covariance of a mixture of both in equal
// parts, about its mean. The pose that is given is not this mean, but the best one: about it, half of the squared way is expected.
// `covariance` is that of each of them.
Mat6 with_rivals(const LineSearch& search, const Mat6& covariance);

// Does the cost rise as the covariance says? Five sigmas off along an axis it should be higher by 25. Where it is not higher by 16, either
// way, the sigma is doubled until it is; without an end within the model's radius the axis is unseen. Axes more certain than a 500th of the
// radius are left: five of their sigmas are 0.6 deg. So are those whose five sigmas reach beyond the radius: they say so. `covariance` is
// that of the hits (covariance_of_hits), of a noise whose variance is `scale` times the assumed one. Bound: one eigen-decomposition, and 14
// passes over the points for each axis.
void widen_weak_axes(const Mission& mission, const HitSolution& hits, double scale, Workspace& workspace, Mat6& covariance,
                     Directions& unseen);

}  // namespace lasso
