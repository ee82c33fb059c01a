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
  typename N::Length p[3];               // measured point, sensor frame at the reference time
  typename N::Unit u[3];                 // direction of its ray
  typename N::Variance range_variance;   // m^2, along the ray
  typename N::Variance across_variance;  // m^2, across the ray
  typename N::Length reach;              // m, kernel width times sigma: how far from the point its surface may lie along the ray
  std::uint32_t element;                 // last element hit, or kNoElement
  bool aimed;                            // at a contour: no surface where it was measured says nothing against a pose that is a little off
};

// An edge of the model that is on the contour of this view, projected on the sensor's tangent plane.
template <class N>
struct ContourEdge {
  std::uint32_t edge;           // index into Mission::edges
  typename N::Tangent x, y;     // of its first end
  typename N::Tangent dx, dy;   // to its second end
  typename N::Inverse2 length;  // of (dx, dy), to find places along it
  typename N::Length za, zb;    // depths of its ends
};

constexpr std::size_t kEdgesPerRay = 4;

// The contour edges closest to a ray in the image, nearest first.
template <class N>
struct RayEdges {
  std::uint32_t count;
  std::uint32_t contour[kEdgesPerRay];       // index into the view's contour
  typename N::Area distance2[kEdgesPerRay];  // m^2 at the edge's depth
  typename N::Unit along[kEdgesPerRay];      // of the closest point, 0..1 in the image
};

constexpr int kRayBins = 32;  // bins across the scan, each way

// Rays sorted into bins of the tangent plane.
template <class N>
struct RayBins {
  typename N::Tangent x[kMaxRays], y[kMaxRays];  // where each ray meets the tangent plane, seen from the target's depth
  typename N::Tangent x0, y0;
  typename N::BinRate bins_per_x, bins_per_y;
  std::uint16_t start[kRayBins * kRayBins + 1];
  std::uint16_t ray[kMaxRays];
};

// One hit/miss label: s(x) = d + a.x is the distance of the ray inside the contour after the step x.
struct Label {
  std::uint16_t ray;
  std::int8_t inside;  // +1 the ray was seen inside, -1 outside
  bool at_end;         // of the edge, beyond which the corner itself is the contour: its lever is the corner's, not the contour's
  double d_m;
  double across_variance;
  Vec6 a;
};

// A place on a contour, or on a surface, that rays of the scan planned next can be aimed at. Rows and steps as of a label, or of a return.
struct AimPlace {
  enum class Fate : std::uint8_t { kOpen, kChosen, kNoContour };

  Vec3 point = Vec3::Zero();   // on the edge or the surface, target frame
  Vec3 across = Vec3::Zero();  // unit, across edge and ray; of a surface across the ray
  Vec6 a = Vec6::Zero();
  double s_pred = 0;    // m, one sigma of where the prediction has the contour; of a surface half of how far its rays spread
  double w = 0;         // 1/m^2, of what its rays will tell
  double gain = 1e300;  // m^2, that they take off the variance of the target's points
  Fate fate = Fate::kOpen;
  bool surface = false;  // or else on a contour
};

constexpr std::size_t kMaxAimSurfaces = 96;

// A ray that says, by hitting or missing, whether a pose is right (outline_fit.hpp).
struct OutlineRay {
  std::uint16_t ray = 0;
  bool open = false;       // poses that are tried ask it
  bool doubtful = false;   // one of them got another answer than the best one
  std::uint8_t best = 0;   // how far it disputes the best pose, in quarters of a ray
  std::uint8_t tried = 0;  // the pose that is tried
};
constexpr std::size_t kOutlineRays = 96;

struct Workspace {
  FixedVector<ScanRay<FlightNumber>, kMaxRays> rays;
  FixedVector<MatchPoint<FlightNumber>, kMaxRays> points;
  FlightNumber::Factor sigma_factor{1};  // the largest of a point: above 1, the scan's own residuals do not say how good it is
  FixedVector<ContourEdge<FlightNumber>, kMaxContourEdges> contour;
  RayEdges<FlightNumber> ray_edges[kMaxRays] = {};
  bool near_contour[kMaxRays] = {};
  RayBins<FlightNumber> bins{};
  FixedVector<Label, kMaxSites> labels;
  FixedVector<AimPlace, kMaxAimPlaces + kMaxAimSurfaces> places;
  FixedVector<OutlineRay, kOutlineRays> outline;
};

}  // namespace lasso
