// A few extreme points that stand for the model when a scan is aimed and fitted.
#pragma once

#include "mdat/modelc/surface.hpp"

namespace lasso::mdat {

// At most `count_max` vertices: those extreme along the axes, then again and again the one by which the model sticks out farthest from
// the points chosen so far, over some thousand directions, until that is less than 1e-6 of the extent. If the count does not suffice (a
// finely round body), all points are moved outward by half of what is still missing.
std::vector<Vec3d> extreme_points(const std::vector<Vec3d>& vertices, double extent_m, std::size_t count_max);

}  // namespace lasso::mdat
