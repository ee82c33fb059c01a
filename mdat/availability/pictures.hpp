// What the heads see at some times of the approach.
#pragma once

#include <string>
#include <vector>

#include "mdat/availability/comparison.hpp"
#include "mdat/report/scene_view.hpp"

namespace lasso::mdat {

// In the middle of each stretch of one light (at most six, in order): the pictures of the left camera without and with the lamp, with the
// exposure that the head chooses, and the laser's scan on a view of the target that needs no light. Rendered anew with `options`; threads
// change nothing.
std::vector<SeenPicture> approach_pictures(const ComparisonOptions& options, const HeadComparison& comparison);

// Frames of the approach in the middle of the stretches of one light, ascending.
std::vector<std::size_t> shown_times(const std::vector<SeenFrame>& frames);

}  // namespace lasso::mdat
