// Where to scan next: aims at the target and fits the scan's extents to it, from the reference model and the predicted pose.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

using HullPoint = HullPointOf<FlightNumber>;  // target frame, metres

// What the planner knows of the target.
struct TargetOutline {
  Span<const HullPoint> hull;    // extreme points of the model; at most kMaxHullPoints
  Vec3 center_m = Vec3::Zero();  // target frame: the geometric centre
  double uncertainty_m = 0;      // how far off the prediction may be, one sigma: the scan reaches that much farther on each side
};

// The plan of scan `scan_id` for a target predicted at T_sensor_target.
//
// On the tangent plane z = 1 the scan is the rectangle around the projected hull points (those in front of the sensor), widened about its
// middle by scan.margin and by the prediction's uncertainty, and cut at the field of view; its middle is the plan's centre. For a target
// seen whole this is the paper's aim at the geometric centre, up to perspective; a target larger than the field of view on both sides is
// cut alike on both, and one that is partly outside is scanned where it can be seen. The rectangle's ends are rounded to a grid, the
// largest power of two that is at most 1/32 of its half extent: so two predictions that differ by far less than they are uncertain (those
// of a simulated sensor, and of the same at the end of a line) mostly have the same rays, and their estimates stay together. The phase is
// the fraction of scan_id * scan.phase_step_turns.
//
// `parameters` as the loader validates them. Refused, with `plan` as it was: kNotFinite or kBadValue for a pose that is not finite or not
// of unit length, kNoData without hull points, kBadValue for a centre that is not in front of the sensor, a target wholly outside the
// field of view, or a plan that validate() refuses (cycle counts that are not coprime, ...). Loop bound: the hull points.
Status plan_scan(const MissionParameters& parameters, const TargetOutline& target, const Pose& T_sensor_target, std::uint32_t scan_id,
                 ScanPlan& plan);

// The plan of scan `scan_id` over the whole field of view, for a target of which nothing is known. kBadValue as above.
Status plan_full_field(const MissionParameters& parameters, std::uint32_t scan_id, ScanPlan& plan);

}  // namespace lasso
