// Directions of the pose that a scan does not show: a tube's roll, a plate's shift within itself. All that the normal equations know along
// them is the wide prior that keeps these solvable (gauss_newton.hpp), which is no measurement and must not pass for one.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

constexpr double kUnobservableSigma = 3;  // along such a direction, of the model's radius: anywhere
constexpr double kUnobservableLever =
    0.05;  // of a label: one that reacts more than this to such a direction has no meaning while it is unknown

// (rotation * radius, translation) of a step; a row of a step is scaled by the inverse.
Vec6 radius_scale(double radius_m);

struct Directions {
  int count = 0;
  Mat6 vectors = Mat6::Zero();  // the first `count` columns: unit vectors over (rotation * radius, translation), target axes
};

// What the prior adds to the information along each direction, 1/m^2 at the model's radius, in a scan whose hits have the information
// H(3..5, 3..5) of this trace.
double prior_information(double radius_m, double translation_trace);

// The covariance that the hits leave, target axes: the inverse of H less the prior in it, times `scale` (the noise's variance over the
// assumed one). Where less is known than the prior says, the direction is unobservable and has the sigma kUnobservableSigma. H is positive
// definite. Bound: one eigen-decomposition, where the prior counts at all.
Mat6 covariance_of_hits(double radius_m, const Mat6& H, double scale, Directions& unobservable);

// Takes what the label would say of unobservable directions out of its row; false where that is too much for it to mean anything.
bool remove_unobservable(double radius_m, const Directions& unobservable, Label& label);

}  // namespace lasso
