// How densely the rays of a scan pattern lie. Inside of missiondb.
#pragma once

#include "fsw/mission/parameters.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso::mdat {

// Rays of a scan that follow the pattern, where as many as may be are aimed.
double pattern_rays(const MissionParameters& parameters);

// The pattern of the mission's scan `scan_id`, laid on the square from -1 to 1.
ScanPlan pattern_of(const MissionParameters& parameters, std::uint32_t scan_id);

// Radius of the largest disc around a point of the unit disc into which no ray falls, in half extents of the scan, the largest of some
// successive scans. By brute force on a raster of points: within 0.03. Of a plan that is not valid: 0.
double largest_gap(const MissionParameters& parameters);

// What as many rays leave that lie evenly, on a square lattice.
double even_gap(double points);

}  // namespace lasso::mdat
