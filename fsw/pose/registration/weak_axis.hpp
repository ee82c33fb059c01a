// Tests of a registration along its least certain axes. Gauss-Newton knows only the surfaces that the rays meet now. A few of them that met
// the wrong one keep the pose at a wrong place, and the normal equations take it for certain. So costs are compared (profile.hpp).
//
// Axes are eigenvectors of the hits' covariance over (rotation * radius, translation), target axes. Lengths along them are metres at the
// model's radius: five sigmas of a 500th of it are 0.6 deg.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "fsw/pose/scan/start_point.hpp"

namespace lasso {

// Moves the registration to its minimum along the least certain axis that its hits see at all: small parts alone tell the roll of a round
// body, or where a wing lies along itself. An axis more certain than a 500th of the radius is looked at where a track predicted a pose that
// is more than five sigmas off along it. A start that nothing tracked is mostly that far off, and the look costs one and a half times what
// else an estimate does (docs/experiments/2026-11-30-far-from-the-start.md). First steps are five sigmas long, a 100th of the radius at
// least and a tenth at most. Other minima (minima.hpp) are looked for where the axis is not that certain. Nothing moves without
// information, or where the registration explains less than tracking.inlier_share_min. Bound: two inverses, two eigen-decompositions,
// minimise_along and find_minima.
void minimise_weak_axis(const Mission& mission, const StartPoint& start, Workspace& workspace, HitSolution& hits);

// Does the cost rise as the covariance says? Where it is not higher by kRise five sigmas off along an axis, either way, the sigma is
// doubled until it is; without an end within the model's radius the axis is unobservable. Of Gaussian residuals of many returns the bounded
// cost is higher by 0.6 of the square, 15: most such sigmas are doubled once. Axes more certain than a 500th of the radius are left, and
// those whose five sigmas reach beyond it: they say so. `covariance` is that of the hits (covariance_of_hits), of a noise whose variance is
// `scale` times the assumed one. Bound: one eigen-decomposition, one pass over the points, and 14 for each axis.
void widen_weak_axes(const Mission& mission, const HitSolution& hits, double scale, Workspace& workspace, Mat6& covariance,
                     Directions& unobservable);

// Other minima of minimise_weak_axis join the covariance, and their axis what the hits do not show.
void add_others(const HitSolution& hits, Mat6& covariance, Directions& unobservable);

}  // namespace lasso
