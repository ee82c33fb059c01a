// Directions of the pose that the hits leave too loose for labels (silhouette.hpp): which of a model's contours a ray passed is not known
// there. Where the scan's outline settles them (outline_fit.hpp), the pose is held by it while labels are found, and let go again afterwards:
// the outline's rays are the labels' own, and must not count twice.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/silhouette/label_update.hpp"
#include "fsw/pose/silhouette/outline_fit.hpp"

namespace lasso {

// Axes of the covariance (target axes) whose sigma at the model's radius is above estimation.silhouette_band_m, if one is above a tenth of
// the radius. Bound: one eigen-decomposition.
Directions find_slack(const Mission& mission, const Mat6& covariance);

// What the outline says along some of them.
struct Hold {
  Directions axes;
  Vec6 sigma_m = Vec6::Zero();  // of each of them, at the model's radius
  double band_m = 0;            // how far from the contours labels must be looked for
};

// Half of the way to where more rays dispute the pose is a sigma; what is already in the labels' band, half of that. A way of an eighth of
// the radius holds nothing, nor does a sigma above the hits'. Directions of which neither says anything are left in `unseen`.
Hold hold_by(const Mission& mission, const OutlineFit& outline, const Directions& slack, const Mat6& covariance, Directions& unseen);

// Keeps of the axes, turned within themselves, those that the labels' contours show: a good part of the rows lie along it by more than
// kUnseenLever, and by more than the hold's sigma is of the radius (a disc's facets show its turn only to who knows on which of them each
// ray passed). The others are let go, into `unseen` where the hits do not show them either. Where all are shown nothing changes. Bound: one
// eigen-decomposition.
void keep_shown(const Mission& mission, Span<const Label> labels, const Mat6& covariance, Hold& hold, Directions& unseen);

// The covariance with a measurement along each axis.
Mat6 hold_slack(double radius_m, const Hold& hold, const Mat6& covariance);

// The covariance without these measurements, whatever else it has taken in since; no sigma becomes larger than kUnseenSigma by that.
Mat6 release_slack(double radius_m, const Hold& hold, const Mat6& covariance);

// To what is believed by now, less certain by kCautious. Gives the step along the axes to where it is believed; target axes.
Vec6 narrow_hold(const Mission& mission, const PoseBelief& belief, Hold& hold);
constexpr double kCautious = 3;

}  // namespace lasso
