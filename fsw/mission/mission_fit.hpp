// Whether a mission fits the board, and one that is to take its place.
#pragma once

#include "fsw/mission/mission.hpp"

namespace lasso {

// Parameters that are right by themselves but not together, or not on a board with so many sensors; nullptr: none.
const char* fault_of(const Mission& mission, const Parts& parts, std::size_t sensors);

// Why `next` cannot take the place of `present` while the component works; nullptr: it can.
const char* fault_of_change(const Mission& present, const Mission& next);

// A track of `present` is one of `next`: the same target, seen by as many sensors, with as many parts.
bool keeps_track(const Mission& present, const Parts& parts, const Mission& next, const Parts& next_parts);

}  // namespace lasso
