// Expectation propagation of hit/miss labels onto a Gaussian pose: mean and covariance after the labels are known.
//
// A label's likelihood is e + (1 - e) Phi(y s / sigma), with s = d + a.x the distance inside the contour, y = +1 or -1 the side it was seen
// on, sigma the contour's and the pointing's uncertainty, and e the probability that the label is wrong (a ray that dropped out looks like
// a miss). Minka, "A family of algorithms for approximate Bayesian inference" (2001); docs/experiments/2026-11-25-silhouettes.md.
#pragma once

#include "fsw/core/span.hpp"
#include "fsw/geometry/types.hpp"
#include "fsw/mission/parameters.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

struct PoseBelief {
  Vec6 mean = Vec6::Zero();  // step from the pose at which the labels were found
  Mat6 covariance = Mat6::Zero();
};

constexpr int kMaxLabelSweeps = 12;

// At most kMaxLabelSweeps sweeps over at most kMaxSites labels. The belief's covariance never grows.
void apply_labels(Span<const Label> labels, const MissionParameters& parameters, PoseBelief& belief);

}  // namespace lasso
