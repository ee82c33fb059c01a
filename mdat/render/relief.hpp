// Relief and shades of a surface as functions of the place in the target: every camera, at any time, sees the same.
#pragma once

#include <cstdint>

#include "fsw/geometry/types.hpp"

namespace lasso::mdat {

// How much a surface leans at a place, as a vector whose components have a root mean square of 1: evenly within each cell of a Voronoi
// pattern of unit size (Worley 1996), so that the surface has facets. The pattern depends on `seed`.
Vec3 facet_tilt(const Vec3& place, std::uint32_t seed);

// Smooth noise of unit cells, -1 to 1: values at whole coordinates, drawn by `seed`, cubic between (value noise).
double smooth_noise(const Vec3& place, std::uint32_t seed);

}  // namespace lasso::mdat
