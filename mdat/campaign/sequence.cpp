#include "mdat/campaign/sequence.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "mdat/common/double_policy.hpp"

namespace lasso::mdat {
namespace {

constexpr double kPrior = 0.5;                 // Beta(1/2, 1/2): narrow limits of shares near 0 and 1, which is where campaigns are
constexpr double kLogPi = 1.1447298858494002;  // ln B(1/2, 1/2)
constexpr int kBisections = 60;

// ln Gamma of Boost, in doubles throughout: that of libm writes a global variable, and is not the same everywhere.
double log_gamma(double x) { return boost::math::lgamma(x, DoublePolicy()); }

double log_mixture(double within, double cases) {
  return log_gamma(within + kPrior) + log_gamma(cases - within + kPrior) - log_gamma(cases + 2 * kPrior) - kLogPi;
}

// ln(p^within (1 - p)^(cases - within)) with 0 ln 0 = 0.
double log_likelihood(double within, double cases, double p) {
  const double in = within > 0 ? within * std::log(p) : 0;
  return in + (cases > within ? (cases - within) * std::log1p(-p) : 0);
}

// From a share whose likelihood is at least `floor` towards `outer`, where it is less: the outermost one that is not less.
double limit_towards(double outer, double inner, double within, double cases, double floor) {
  for (int step = 0; step < kBisections; ++step) {
    const double middle = (inner + outer) / 2;
    (log_likelihood(within, cases, middle) < floor ? outer : inner) = middle;
  }
  return outer;
}

}  // namespace

Limits share_sequence(double within, double cases, double confidence) {
  if (cases <= 0) return {};
  const double floor = log_mixture(within, cases) + std::log(1 - confidence), share = within / cases;
  Limits limits;
  if (within > 0) limits.lower = limit_towards(0, share, within, cases, floor);
  if (within < cases) limits.upper = limit_towards(1, share, within, cases, floor);
  return limits;
}

}  // namespace lasso::mdat
