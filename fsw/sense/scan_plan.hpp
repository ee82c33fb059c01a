// What a scan is to look like. Directions are set on the tangent plane z = 1 of the sensor frame (z boresight, x right, y down).
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso {

enum class PatternKind : std::uint8_t { kRosette = 0, kLissajous = 1, kRaster = 2 };

// A ray with a direction of its own: where it meets the tangent plane.
struct AimedRay {
  float x = 0, y = 0;
};
using AimedRays = FixedVector<AimedRay, kMaxAimedRays>;

struct ScanPlan {
  std::uint32_t scan_id = 0;
  PatternKind kind = PatternKind::kRosette;
  std::uint16_t points = 1024;  // 16..kMaxRays
  std::uint16_t cycles_a = 19;  // rosette, Lissajous: coprime; raster: lines (cycles_b unused)
  std::uint16_t cycles_b = 12;
  double phase_turns = 0;             // [0, 1): turns the pattern's start from scan to scan
  double center_x = 0, center_y = 0;  // tangent-plane coordinates of the middle
  double half_x = 0.1, half_y = 0.1;  // half extents on the tangent plane, > 0
  DurationUs duration_us = 180000;    // first to last sample
  // Rays in the middle of the scan that leave the pattern, in this order; `points` counts them, and the pattern gets the rest. They are
  // the caller's, who leaves them as they are until the scan has ended.
  Span<const AimedRay> aimed;
};

}  // namespace lasso
