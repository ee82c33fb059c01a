// Scan patterns: the direction and the time of each ray of a plan. Pure functions of the plan; nothing here touches a sensor.
//
// A plan's aimed rays come in the middle of the scan, where rates that are wrong move the target least; the pattern's rays before and after
// them are those of a plan without. Below, index and points are counted without the aimed rays.
//
// A pattern lives in the square [-1, 1]^2 and is laid on the tangent plane z = 1: x = center_x + half_x px, y = center_y + half_y py.
// With s = index / points, A = 2 pi (cycles_a s + phase_turns) and B = 2 pi cycles_b s:
//   rosette    px = (cos A + cos B) / 2, py = (sin A - sin B) / 2; coprime cycle counts close the curve after `points`, and the phase turns
//              the whole figure (in the square) by phase * cycles_b / (cycles_a + cycles_b) turns
//   Lissajous  px = sin A, py = sin B
//   raster     cycles_a lines from top to bottom, every second one run backwards; the phase moves the rays along the path by that share of
//              the ray spacing. Lines lie in the middle of equal strips, so that each ray stands for the same area.
#pragma once

#include <cstdint>

#include "fsw/core/status.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

constexpr std::uint16_t kMinPatternPoints = 16;
constexpr double kMaxTangent = 2.0;                     // |center| + half on the tangent plane: 63 degrees off the boresight
constexpr DurationUs kMaxScanDurationUs = 100'000'000;  // longest scan

// kNotFinite: a real number of the plan is not finite. kBadValue: points not within kMinPatternPoints..kMaxRays, duration not within
// 1..kMaxScanDurationUs, phase not within [0, 1), a half extent not above 0, the pattern reaching beyond kMaxTangent, an unknown kind,
// more than kMaxAimedRays aimed rays or fewer than kMinPatternPoints beside them, one beyond kMaxTangent, cycle counts not
// within 1..points/2 (raster: lines), or, rosette and Lissajous, equal or not coprime. Bound: 24 steps of Euclid's.
Status validate(const ScanPlan& plan);

// How many rays follow the pattern, and the index of the first aimed one after half of them.
std::uint16_t pattern_points(const ScanPlan& plan);
std::uint16_t first_aimed(const ScanPlan& plan);

// Unit vector of ray `ray` (< plan.points, an invariant), aimed or of the pattern, sensor frame. The plan must be valid.
Vec3 pattern_direction(const ScanPlan& plan, std::uint16_t ray);

// Time of ray `index` (< points, an invariant) after the first one: rays are evenly spaced, the last one is taken at duration_us.
// Rounded down to whole microseconds.
DurationUs pattern_time_us(const ScanPlan& plan, std::uint16_t index);

// All directions in order with four sines for the whole scan: the angles A and B step by complex multiplication. Differs from
// pattern_direction by less than 1e-11 after kMaxRays steps.
class PatternGenerator {
 public:
  explicit PatternGenerator(const ScanPlan& plan);  // a valid plan

  bool done() const { return index_ == plan_.points; }
  std::uint16_t index() const { return index_; }  // of the ray that next() will give
  Vec3 next();                                    // not when done (an invariant)

 private:
  ScanPlan plan_;
  SinCos a_, b_, step_a_, step_b_;
  std::uint16_t index_ = 0;
};

}  // namespace lasso
