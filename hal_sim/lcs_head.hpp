// A head's optics, laser camera, LIDAR or TriDAR: what it measures of a point, before any line.
#pragma once

#include "fsw/sense/range_image.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/optics.hpp"
#include "hal_sim/lcs_faults.hpp"

namespace lasso::sim {

struct LcsCamera {
  lcs::Device device = lcs::Device::kLaserCamera;
  lcs::Calibration truth;      // of its optics; what the component calibrates it to be may differ
  lcs::EchoCalibration clock;  // the same of a LIDAR's or TriDAR's timing
  double hand_over_m = 10;     // range from which on a TriDAR times its light
  float temperature_degC = 20;
  std::uint32_t clock_us = 0xFFFF0000;  // at time 0: it soon wraps
  double bits_per_s = 4e6;
  LcsFaults faults;
};

// Of those of the camera's members that its kind has. Throws std::invalid_argument for optics that are not valid.
lcs::Optics optics_of(const LcsCamera& camera);
// Whether the camera's mirrors reach the plan's corners.
bool within_mirrors(const LcsCamera& camera, const ScanPlan& plan);

// The raw sample by which a camera tells a point at `range_m` along `direction` (any range for kNothing).
lcs::RawSample raw_sample(const lcs::Calibration& truth, double temperature_degC, const Vec3& direction, double range_m);
// The same of a head that times its light.
lcs::RawSample raw_echo(const lcs::EchoCalibration& truth, double temperature_degC, const Vec3& direction, double range_m);
// What the head tells of a ray along `direction` that `seen` is true of, by the way of measuring that its kind has: a miss or a saturated
// return has mirror angles alone.
lcs::RawSample raw_of(const LcsCamera& camera, const Vec3& direction, const RangeSample& seen);

}  // namespace lasso::sim
