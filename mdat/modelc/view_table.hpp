// The views of the model that the search for a first pose starts from.
#pragma once

#include "mdat/modelc/elements.hpp"
#include "mdat/modelc/surface.hpp"

namespace lasso::mdat {

constexpr std::size_t kViewCount = 642;  // about 8 deg apart

struct View {
  Vec3d direction;             // unit, from the target to the sensor
  Vec3d centroid;              // of what is seen from afar, each part weighted by its area across the line of sight
  Vec3d near_centroid;         // the same from kNearView extents before the middle of the model
  double median, near_median;  // how much farther from the eye than these the median depth is
  std::vector<Vec3d> seen;     // from afar: points spread evenly
};

// Directions spread evenly over the sphere (Fibonacci). Deterministic.
std::vector<Vec3d> spread_directions(std::size_t count);

// Ray casts from afar on all processor cores. Where nothing is seen (a sheet edge-on) the centroid is that of the bounding box.
// Throws CompileError where the search structure cannot be built.
std::vector<View> make_views(const Surface& surface);

std::vector<std::uint32_t> view_words(const std::vector<View>& views, const LengthScale& scale);  // table kViews

}  // namespace lasso::mdat
