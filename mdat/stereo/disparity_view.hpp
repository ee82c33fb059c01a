// Disparities as a picture for people, and as a cloud of points.
#pragma once

#include <string>
#include <vector>

#include "mdat/pair/disparity_map.hpp"
#include "mdat/render/picture.hpp"

namespace lasso::mdat {

// Near warm, far cool, over the disparities that are there but for the outermost hundredths; dark grey where there is none. With a legend
// in metres of depth.
Picture disparity_view(const DisparityMap& map);

// Disparities against the true ones (disparity_errors.hpp): blue too far, red too near, up to 1 pixel; what is more wrong, or sky, is
// magenta.
Picture error_view(const DisparityMap& map, const std::vector<double>& truth_px);

// Every pixel with a disparity as a point of the left camera's frame, metres: a binary PLY file, as mdat replay reads it. Holes are left
// out: a dark pixel may be shadow as well as sky, so that none is a miss.
std::string range_ply(const DisparityMap& map);

}  // namespace lasso::mdat
