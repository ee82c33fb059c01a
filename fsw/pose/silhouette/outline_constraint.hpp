// Directions of the pose that the hits leave too loose for labels (silhouette.hpp): which of a model's contours a ray passed is not known
// there. Where the scan's outline fixes them (outline_fit.hpp), it constrains the pose while labels are found, and is removed
// afterwards: the outline's rays are the labels' own, and must not count twice.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/silhouette/label_update.hpp"
#include "fsw/pose/silhouette/outline_fit.hpp"

namespace lasso {

// Axes of the covariance (target axes) whose sigma at the model's radius is above estimation.silhouette_band_m, if one is above a tenth of
// the radius. Bound: one eigen-decomposition.
Directions find_weakly_observable(const Mission& mission, const Mat6& covariance);

// What the outline says along some of them.
struct OutlineConstraint {
  Directions axes;
  Vec6 sigma_m = Vec6::Zero();  // of each of them, at the model's radius
  double band_m = 0;            // how far from the contours labels must be looked for
};

// For each of these directions 1 sigma is half the distance at which more rays contradict the pose, or half of that within the labels'
// band. A distance of an eighth of the radius constrains nothing, nor does a sigma above the hits'. Directions of which neither says
// anything are left in `unobservable`.
OutlineConstraint constrain_by_outline(const Mission& mission, const OutlineFit& outline, const Directions& weakly_observable,
                                       const Mat6& covariance, Directions& unobservable);

// Keeps of the axes, turned within themselves, those that the labels' contours show: a good part of the rows lie along it by more than
// kUnobservableLever, and by more than the constraint's sigma is of the radius (a disc's facets show its turn only to who knows on which of
// them each ray passed). The others are dropped, into `unobservable` where the hits do not show them either. Where all are shown nothing
// changes. Bound: one eigen-decomposition.
void keep_shown(const Mission& mission, Span<const Label> labels, const Mat6& covariance, OutlineConstraint& constraint,
                Directions& unobservable);

// The covariance with a measurement along each axis.
Mat6 add_constraint(double radius_m, const OutlineConstraint& constraint, const Mat6& covariance);

// The covariance without these measurements, whatever else it has taken in since; no sigma becomes larger than kUnobservableSigma by that.
Mat6 remove_constraint(double radius_m, const OutlineConstraint& constraint, const Mat6& covariance);

// To what is believed by now, less certain by kCautious. Gives the step along the axes to where it is believed; target axes.
Vec6 tighten_constraint(const Mission& mission, const PoseBelief& belief, OutlineConstraint& constraint);
constexpr double kCautious = 3;

}  // namespace lasso
