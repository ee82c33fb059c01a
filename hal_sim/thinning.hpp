// Fewer points of many, spread evenly over where they are: surfaces, or directions.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/geometry/types.hpp"

namespace lasso::sim {

// At most `most` of the points, by their indices, ascending; all of them where they are no more. The cubes of an octree are halved until
// more than `most` of them hold points; of each cube that does the first point is a candidate, and of the candidates, in the order of a Z
// curve (Morton 1966), which goes through space without jumps, evenly many are left out. O(n log n). Coordinates and their differences
// have to be finite.
std::vector<std::uint32_t> thinned(const std::vector<Vec3>& points, std::size_t most);

}  // namespace lasso::sim
