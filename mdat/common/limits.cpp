#include "mdat/common/limits.hpp"

#include <boost/math/special_functions/beta.hpp>

#include "mdat/common/double_policy.hpp"

namespace lasso::mdat {

double lower_share_limit(double within, double cases, double confidence) {
  return within <= 0 ? 0 : boost::math::ibeta_inv(within, cases - within + 1, 1 - confidence, DoublePolicy());
}

double upper_share_limit(double within, double cases, double confidence) {
  return within >= cases ? 1 : boost::math::ibetac_inv(within + 1, cases - within, 1 - confidence, DoublePolicy());
}

Limits share_limits(double within, double cases, double confidence) {
  const double each = (1 + confidence) / 2;  // half of what is not confident lies on either side
  return {lower_share_limit(within, cases, each), upper_share_limit(within, cases, each)};
}

}  // namespace lasso::mdat
