#include "mdat/common/share_text.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Rounding = double (*)(double);
double down(double value) { return std::floor(value); }
double up(double value) { return std::ceil(value); }
double to_nearest(double value) { return std::round(value); }

// One decimal of the percentage, and more as the share comes near 0 or 1.
int percent_decimals(double share) {
  const double missing = std::min(share, 1 - share);
  return missing <= 0 ? 0 : std::clamp(static_cast<int>(std::ceil(-std::log10(missing))) - 1, 1, 7);
}

std::string rounded(double share, Rounding rounding) {
  const int count = percent_decimals(share);
  const double unit = std::pow(10, count);
  return decimals(rounding(100 * share * unit) / unit, count) + " %";
}

}  // namespace

std::string share_text(double share) { return rounded(share, to_nearest); }

std::string lower_limit_text(double limit) { return rounded(limit, down); }

std::string upper_limit_text(double limit) { return rounded(limit, up); }

std::string limits_text(const Limits& limits) { return lower_limit_text(limits.lower) + " to " + upper_limit_text(limits.upper); }

}  // namespace lasso::mdat
