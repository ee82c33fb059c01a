// From what the laser camera measures to a ray and a range: synchronised triangulation, and what its calibration found to be different in
// this one camera.
//
// With mirror angles a_x, a_y, the spot at p on the detector, focal length f and baseline d, a point on the ray (tan a_x, tan a_y, 1) lies
// at the depth
//   z = f d / (p + f tan a_x)                                                         (Rioux 1984; docs/icd/lcs.md)
// f and d grow with the temperature; angles have offsets, p has a half width that scales the wire's [-1, 1), an offset with its own
// drift, and a residual that is a polynomial:
//   p = half_width (peak + sum_k c_k phi_k),  phi = 1, x, y, q, x^2, x y, y^2, x q, y q, q^2,  x, y the angles, q the peak
// Frame: sensor, metres (fsw/sense/range_image.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/status.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_lcs/messages.hpp"

namespace lasso::lcs {

constexpr std::size_t kResidualTerms = 10;

struct Calibration {
  std::uint32_t serial = 0;  // of the camera that it is for; not 0
  double focal_length_m = 0.08;
  double baseline_m = 0.2;
  double half_width_m = 0.08;     // of the detector
  double angle_x_offset_rad = 0;  // added to what the mirrors say
  double angle_y_offset_rad = 0;
  double focal_length_per_K = 0;  // relative growth
  double baseline_per_K = 0;
  double peak_per_K = 0;  // half widths
  double reference_degC = 20;
  double residual[kResidualTerms] = {};
  // Where it was calibrated.
  double angle_max_rad = 0.3;  // either mirror
  double depth_min_m = 0.5;
  double depth_max_m = 12;
  double temperature_min_degC = -20;
  double temperature_max_degC = 50;
};

// kNotFinite; kSingular: focal length, baseline or half width not above 0 (at any temperature of the range), or a spot that does not grow
// with the peak; kBadValue: a volume without content, or angles beyond the wire's.
Status validate(const Calibration& calibration);

enum class Fate : std::uint8_t {
  kPoint = 0,
  kNothing = 1,      // the ray met nothing
  kNoStatement = 2,  // saturated, not aimed in time, or by a way of measuring that the head does not have
  kBadAngle = 3,     // a mirror outside its range
  kBadPeak = 4,      // a spot, or a flight time, where no point in front of the head can be
  kOutside = 5,      // outside the calibrated volume or temperatures: no statement
};

// Where a raw sample's mirrors look. `sample` gets its time, its direction and, for kNothing, its state; kPoint: the sample is of the kind
// `measured`, and its range is still to be found. Offsets are added to the angles, either of which is at most max_rad then.
struct Mirrors {
  double x_offset_rad, y_offset_rad, max_rad;
};
struct MirrorRay {
  Fate fate = Fate::kNoStatement;
  double x_rad = 0, y_rad = 0;  // the angles
  double tan_x = 0;
  double length = 1;  // of (tan x, tan y, 1)
};
MirrorRay look(const RawSample& raw, const Mirrors& mirrors, SampleKind measured, TimeUs t_us, RangeSample& sample);

// What the temperature leaves of a calibration: made once a scan.
class Triangulation {
 public:
  // `calibration` is valid.
  Triangulation(const Calibration& calibration, double temperature_degC);

  // The sample of the ray that the raw one is, at time t_us. Its state is kHit for kPoint, kMiss for kNothing, else kInvalid.
  Fate convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const;

  bool temperature_known() const { return temperature_known_; }  // it lies in the calibrated range

 private:
  double spot_m(double x, double y, double peak) const;

  Calibration c_;
  double warmer_K_;
  double focal_length_m_, baseline_m_;
  bool temperature_known_;
};

}  // namespace lasso::lcs
