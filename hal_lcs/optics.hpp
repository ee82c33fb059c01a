// What a head's raw samples become points by: the calibration of a laser camera, of a LIDAR, or both of a TriDAR, whose every sample says
// how it was measured. One driver (driver.hpp) serves all three, as they share the line.
#pragma once

#include <cstdint>

#include "fsw/core/status.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/time_of_flight.hpp"
#include "hal_lcs/triangulation.hpp"

namespace lasso::lcs {

class Optics {
 public:
  explicit Optics(const Calibration& laser_camera);
  explicit Optics(const EchoCalibration& lidar);
  // A TriDAR: one head, so one serial number, and the same mirrors.
  Optics(const Calibration& near, const EchoCalibration& far);

  // The reason of the calibration that is not valid; kBadValue: a TriDAR's two are of different heads or mirrors.
  Status validate() const;

  // The same head with this calibration of its triangulation, which is valid: a TriDAR's clock keeps its own, behind the same mirrors. A
  // LIDAR, which has none, is then a head that nobody knows.
  Optics calibrated(const Calibration& calibration) const;

  Device device() const { return device_; }
  std::uint32_t serial() const { return triangulates() ? near_.serial : far_.serial; }
  Mirrors mirrors() const;

  // The head's temperature holds for the samples to come; the reference temperature at first. The calibrations are valid.
  void set_temperature(double temperature_degC);
  // The sample of the ray that the raw one is, at time t_us. Its state is kHit for kPoint and kBeside, kMiss for
  // kNothing, else kInvalid.
  Fate convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const;

 private:
  Optics(Device device, const Calibration& near, const EchoCalibration& far);
  bool triangulates() const { return device_ != Device::kLidar; }
  bool times() const { return device_ != Device::kLaserCamera; }
  bool one_head() const;

  Device device_;
  Calibration near_;
  EchoCalibration far_;
  Triangulation triangulation_;
  TimeOfFlight time_of_flight_;
};

}  // namespace lasso::lcs
