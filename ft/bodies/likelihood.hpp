// The likelihood of a whole scan at a pose, as a sum over its rays: of returns, of misses, and of what is neither explained. It compares
// poses (compare.hpp). A measure on the ground: flight code has other scores (docs/experiments/2026-11-28-one-likelihood.md).
#pragma once

#include "fsw/pose/scan/result.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso::bodies {

// Natural logarithm of the likelihood of the rays of `workspace`, as prepare_rays left it, at the pose of `found`.
//
//   return at range r   (1 - e) [ sum_j w_j (1 - d_j) N(r; t_j, s_j^2) ] + e / (range_max - range_min)
//   miss                (1 - e) [ sum_j w_j d_j ] + e
//
// with t_j the range at which node j meets the model, s_j^2 = sigma_r^2 + ((1 - c^2) (z sigma_angle)^2 + surface^2) / c^2, c the cosine of
// the incidence, and e = 1 - tracking.agreement_min, at least 1/1000, the share of rays that may contradict a right pose. d_j is 1 where
// the node meets nothing within the sensor's ranges, 1/2 where it grazes (estimation.incidence_max_deg), else sensor.dropout_probability.
// A ray that the pose itself explains within three sigmas has one node. Any other has eleven: itself (w 1/2); poses two sigmas off along
// the three least certain axes of `found.covariance`, either way (1/24 each); four lines two sigmas beside it (1/16 each). Where the
// nodes' ranges differ, a quarter of the density is even between the nearest and the farthest, as edges mix ranges. Misses count where
// they are known. Bound: eleven walks for each ray.
double log_likelihood(const Mission& mission, const Registration& found, bool misses_known, const Workspace& workspace);

}  // namespace lasso::bodies
