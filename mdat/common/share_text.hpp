// A share and its limits, in percent.
#pragma once

#include <string>

#include "mdat/common/limits.hpp"

namespace lasso::mdat {

// Two digits of what is missing to 0 or 1: "99.42 %". A lower limit is rounded down, an upper one up: the text promises no more than they
// do.
std::string share_text(double share);
std::string lower_limit_text(double limit);
std::string upper_limit_text(double limit);
std::string limits_text(const Limits& limits);  // "98.26 % to 99.88 %"

}  // namespace lasso::mdat
