// From a range image to the rays and points that the registration works on: validated, and moved to the scan's reference time.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/start_point.hpp"
#include "fsw/pose/scan/workspace.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

// Fills workspace.rays (every hit and miss, in the scan's order) and workspace.points (the hits). Invalid samples are left out, and returns
// outside the sensor's range. Where estimation.deskew is on, each ray is moved by the target's predicted motion between its own time and
// the reference time.
void prepare_rays(const Mission& mission, const RangeImage& scan, const StartPoint& start, Workspace& workspace);

}  // namespace lasso
