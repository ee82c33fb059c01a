// Limits of a share that stay valid however often one looks at them: for campaigns that stop when their question is decided.
#pragma once

#include "mdat/common/limits.hpp"

namespace lasso::mdat {

// A confidence sequence: with at least this confidence the true share lies within the limits after every case, all of them at once, so
// that a look costs nothing, whenever it is made and whatever is decided by it.
//
// Mixture of Robbins (Annals of Mathematical Statistics 41, 1970; for binomial shares Howard, Ramdas, McAuliffe, Sekhon, Annals of
// Statistics 49, 2021): under the true share p the ratio of the likelihood mixed over Beta(1/2, 1/2) to that of p,
//   B(within + 1/2, cases - within + 1/2) / B(1/2, 1/2) / (p^within (1 - p)^(cases - within)),
// is a martingale that begins with 1; by Ville's inequality it ever reaches 1 / (1 - confidence) with at most the probability
// 1 - confidence. The limits hold all p whose ratio is below. The ratio's logarithm is convex in p and not above 0 at within / cases, so
// that bisection finds one limit on each side, in at most 60 steps. Counts may be fractions; 0 <= within <= cases.
Limits share_sequence(double within, double cases, double confidence);

}  // namespace lasso::mdat
