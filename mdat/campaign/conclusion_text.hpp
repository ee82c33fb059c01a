// What a campaign shows of its criteria, in words.
#pragma once

#include <string>

#include "mdat/campaign/conclusion.hpp"

namespace lasso::mdat {

// "wrong <= 0", "2 <= found_s <= 5".
std::string bounds_text(const Criterion& criterion);

// "wrong <= 0 in at least 98 %".
std::string criterion_text(const Criterion& criterion);

// How many cases count as outside as their figure is not a number; empty where there are none.
std::string unknown_text(const Conclusion& conclusion);

// What would decide an undecided one; empty of the others.
std::string what_decides(const Conclusion& conclusion);

// In sentences: how many cases are within, what that shows, which cases count as outside though they have no figure, what would decide it.
std::string conclusion_text(const Conclusion& conclusion);

}  // namespace lasso::mdat
