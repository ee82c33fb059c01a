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
//   corrupt     the scan was lost for what the sensor sent, or is the one before (is_repeated()), or more than kDamagedShare of the
//               samples were damaged on their way, or cannot be
//   stuck       as mirrors_stuck() says
//   saturated   the sensor itself says of more than half of the samples that they mean nothing
//   incomplete  the scan ended early, or too few of its samples are well formed
// A scan for which the laser was not permitted, or whose plan was none, says nothing of the sensor. Loop bound: kBadSampleKinds.
FaultSet scan_faults(const ScanVerdict& verdict);

// Do the rays' directions fill less than kStuckShare of the plan's extents, on either axis? Loop bound: kMaxRays.
bool mirrors_stuck(const ScanPlan& plan, const RangeImage& image);

constexpr double kDamagedShare = 0.05;
constexpr double kStuckShare = 0.25;
constexpr std::size_t kRaysToTell = 32;       // fewer do not tell whether the mirrors move
constexpr std::size_t kTracedRays = 16;       // of a plan, evenly over it
constexpr float kTracedOffset = 1.0F / 8192;  // on the tangent plane: more than mirrors resolve, less than plans differ by that differ

// What is kept of a scan to know it again.
struct ScanTrace {
  std::uint32_t digest = 0;       // CRC-32C of the measured directions and ranges, all of them, bit for bit
  std::size_t rays = 0;           // that say where they went
  AimedRay planned[kTracedRays];  // where its plan wanted some of them
};
// Loop bound: kMaxRays. The plan is valid.
ScanTrace trace_of(const ScanPlan& plan, const RangeImage& image);

// Did the sensor give the scan before once more, whatever its times and number say? Its samples are the same, bit for bit, though its plan
// wanted a traced ray elsewhere, by more than kTracedOffset. Where the plans are the same (scan.phase_step_turns 0, the target at rest),
// nothing can be told: without noise a new scan is then the same as the last. Two scans that differ are taken for one in one of 2^32.
// Loop bound: kTracedRays.
bool is_repeated(const ScanTrace& before, const ScanTrace& scan);

}  // namespace lasso
