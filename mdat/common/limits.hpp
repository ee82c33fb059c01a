// Exact limits of a share (of cases that pass) from a number of cases that was fixed before they were flown.
#pragma once

namespace lasso::mdat {

struct Limits {
  double lower = 0, upper = 1;
};

// Clopper and Pearson (Biometrika 26, 1934) by quantiles of the beta distribution: of all shares, those that `within` of `cases` does not
// contradict. The true share lies between them with at least this confidence (0 to 1), whatever it is. Without cases 0 and 1. Counts may
// be fractions, for estimates; 0 <= within <= cases.
Limits share_limits(double within, double cases, double confidence);

// One of them alone, with all of the confidence on its side.
double lower_share_limit(double within, double cases, double confidence);
double upper_share_limit(double within, double cases, double confidence);

}  // namespace lasso::mdat
