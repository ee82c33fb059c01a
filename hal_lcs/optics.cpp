#include "hal_lcs/optics.hpp"

namespace lasso::lcs {

Optics::Optics(Device device, const Calibration& near, const EchoCalibration& far)
    : device_(device), near_(near), far_(far), triangulation_(near, near.reference_degC), time_of_flight_(far, far.reference_degC) {}
Optics::Optics(const Calibration& laser_camera) : Optics(Device::kLaserCamera, laser_camera, EchoCalibration{}) {}
Optics::Optics(const EchoCalibration& lidar) : Optics(Device::kLidar, Calibration{}, lidar) {}
Optics::Optics(const Calibration& near, const EchoCalibration& far) : Optics(Device::kTridar, near, far) {}

bool Optics::one_head() const {
  return near_.serial == far_.serial && near_.angle_x_offset_rad == far_.angle_x_offset_rad &&
         near_.angle_y_offset_rad == far_.angle_y_offset_rad && near_.angle_max_rad == far_.angle_max_rad;
}

Status Optics::validate() const {
  const Status near = triangulates() ? lasso::validate(near_) : Status::kOk;
  if (near != Status::kOk) return near;
  const Status far = times() ? lcs::validate(far_) : Status::kOk;
  if (far != Status::kOk) return far;
  return device_ != Device::kTridar || one_head() ? Status::kOk : Status::kBadValue;
}

Optics Optics::calibrated(const Calibration& calibration) const {
  EchoCalibration clock = far_;
  clock.serial = calibration.serial;
  clock.angle_x_offset_rad = calibration.angle_x_offset_rad;
  clock.angle_y_offset_rad = calibration.angle_y_offset_rad;
  clock.angle_max_rad = calibration.angle_max_rad;
  return {triangulates() ? device_ : Device::kLaserCamera, calibration, clock};
}

Mirrors Optics::mirrors() const {
  if (triangulates()) return {near_.angle_x_offset_rad, near_.angle_y_offset_rad, near_.angle_max_rad};
  return {far_.angle_x_offset_rad, far_.angle_y_offset_rad, far_.angle_max_rad};
}

void Optics::set_temperature(double temperature_degC) {
  triangulation_ = Triangulation(near_, temperature_degC);
  time_of_flight_ = TimeOfFlight(far_, temperature_degC);
}

// What a head cannot measure is left to the calibration that makes no statement of it.
Fate Optics::convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const {
  const bool timed = !triangulates() || (times() && raw.kind == SampleKind::kEcho);
  return timed ? time_of_flight_.convert(raw, t_us, sample) : triangulation_.convert(raw, t_us, sample);
}

}  // namespace lasso::lcs
