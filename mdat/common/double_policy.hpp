// Functions of Boost.Math in doubles throughout: long double is not the same on every processor.
#pragma once

#include <boost/math/policies/policy.hpp>

namespace lasso::mdat {

using DoublePolicy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace lasso::mdat
