// From what the laser camera measures to a ray and a range: synchronised triangulation, and what its calibration found to be different in
// this one camera (fsw/mission/calibration.hpp).
// Frame: sensor, metres (fsw/sense/range_image.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/mission/calibration.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_lcs/messages.hpp"

namespace lasso::lcs {

using Calibration = TriangulationCalibration;

enum class Fate : std::uint8_t {
  kPoint = 0,
  kNothing = 1,      // the ray met nothing
  kNoStatement = 2,  // saturated, not aimed in time, or by a way of measuring that the head does not have
  kBadAngle = 3,     // a mirror outside its range
  kBadPeak = 4,      // a spot, or a flight time, where no point in front of the head can be
  kOutside = 5,      // too far outside the calibrated volume or temperatures: no statement
  kBeside = 6,       // a point outside of them by no more than kOutsideMargin: its sample has the calibration's sigma factor
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

  // The sample of the ray that the raw one is, at time t_us. Its state is kHit for kPoint and kBeside, kMiss for kNothing, else kInvalid.
  Fate convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const;

 private:
  double spot_m(double x, double y, double peak) const;
  Fate fate_at(double depth_m) const;

  Calibration c_;
  double warmer_K_;
  double focal_length_m_, baseline_m_;
  double temperature_beyond_;  // of the calibrated range, as shares of it; at most 0: within
};

}  // namespace lasso::lcs
