// What a scan's end and its samples say of the sensor.
#pragma once

#include "fsw/exec/faults.hpp"
#include "fsw/sense/acquisition.hpp"
#include "fsw/sense/range_image.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

// Of a scan that was asked for:
//   silent      the sensor does not answer, or no sample came until the boundary
//   late        the sensor was still busy when it was asked, or its scan did not end in time
//   corrupt     the scan was lost for what the sensor sent, or more than kDamagedShare of the samples were damaged on their way, or cannot
//   be stuck       as mirrors_stuck() says saturated   the sensor itself says of more than half of the samples that they mean nothing
//   incomplete  the scan ended early, or too few of its samples are well formed
// A scan for which the laser was not permitted, or whose plan was none, says nothing of the sensor. Loop bound: kBadSampleKinds.
FaultSet scan_faults(const ScanVerdict& verdict);

// Do the rays' directions fill less than kStuckShare of the plan's extents, on either axis? Loop bound: kMaxRays.
bool mirrors_stuck(const ScanPlan& plan, const RangeImage& image);

constexpr double kDamagedShare = 0.05;
constexpr double kStuckShare = 0.25;
constexpr std::size_t kRaysToTell = 32;  // fewer do not tell whether the mirrors move

}  // namespace lasso
