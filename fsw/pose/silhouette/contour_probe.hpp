// Probing a place on an edge: is the contour there, which one, and on which side of it is the model?
#pragma once

#include "fsw/geometry/types.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

enum class ContourKind : std::uint8_t { kNone, kOuter, kInner };

// A confirmed place on the contour.
struct ContourPoint {
  ContourKind kind = ContourKind::kNone;
  Vec3 outward = Vec3::Zero();  // unit, across the edge and the ray, away from the model
  double range_m = 0;           // of the edge
  double far_range_m = 0;       // of what is seen beside it (inner contours)
};

struct ProbeSettings {
  FlightNumber::Length depth, step;
  double gap_min_m;  // an inner contour's step in range is at least this
};

// range_sigma_m: of a return at the target's range.
ProbeSettings probe_settings(const MissionParameters& parameters, double range_sigma_m);

// Two probe rays from `origin` (the sensor, target frame) a little to either side of `edge`, a point on an edge: one has to meet the model
// at the edge, the other to pass it. `across` is of unit length, across the edge and the ray. kNone where there is no contour. Bound: four
// walks through the field.
ContourPoint probe_contour(const Field<FlightNumber>& field, const ProbeSettings& settings, const Vec3& origin, const Vec3& edge,
                           const Vec3& across);

// The parameter in space of the point at parameter `along` of the projected edge.
double along_in_space(const ContourEdge<FlightNumber>& edge, double along);

}  // namespace lasso
