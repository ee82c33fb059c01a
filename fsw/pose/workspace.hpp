// The estimator's working memory: static, sized by cfg/capacities.hpp.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

// A ray of the scan at the scan's reference time (deskewed), sensor frame. Its line is o + range * u.
template <class N>
struct ScanRay {
  typename N::Length o[3];  // origin: the sensor's, moved by the target's motion since the ray's own time
  typename N::Unit u[3];
  typename N::Length range;  // 0 for a miss
  RayState state;
};

// A return that the registration matches.
template <class N>
struct MatchPoint {
  typename N::Length p[3];    // measured point, sensor frame at the reference time
  typename N::Unit u[3];      // direction of its ray
  typename N::Ratio range_variance;   // m^2, along the ray
  typename N::Ratio across_variance;  // m^2, across the ray
  typename N::Length reach;   // m, kernel width times sigma: how far from the point its surface may lie along the ray
  std::uint32_t element;      // last element hit, or kNoElement
};

// A ray that may label one side of a contour: the nearest contour edges found for it.
struct LabelCandidate {
  std::uint16_t ray;
  std::uint16_t edge;     // index into the view's contour
  float distance_m;       // in the image, at the edge's range
  float along;            // parameter of the closest point on the projected edge, 0..1
};

template <class N>
struct ContourEdge {
  std::uint32_t edge;     // index into Mission::edges
  float ax, ay, bx, by;   // projections on the tangent plane
  float inverse_az, inverse_bz;
};

constexpr int kRayBins = 32;                 // bins across the scan, each way
constexpr std::size_t kMaxLabelCandidates = 2048;

// One hit/miss label: s(x) = d + a.x is the distance of the ray inside the contour after the step x.
struct Label {
  std::uint16_t ray;
  std::int8_t inside;  // +1 the ray was seen inside, -1 outside
  double d_m;
  double across_variance;
  Vec6 a;
};

struct Workspace {
  FixedVector<ScanRay<FlightNumber>, kMaxRays> rays;
  FixedVector<MatchPoint<FlightNumber>, kMaxRays> points;
  FixedVector<ContourEdge<FlightNumber>, kMaxContourEdges> contour;
  FixedVector<LabelCandidate, kMaxLabelCandidates> candidates;
  FixedVector<Label, kMaxSites> labels;
  std::uint16_t bin_start[kRayBins * kRayBins + 1] = {};
  std::uint16_t bin_rays[kMaxRays] = {};
};

}  // namespace lasso
