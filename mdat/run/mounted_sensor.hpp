// A sensor that stands elsewhere than the frame in which the component has its scans.
#pragma once

#include <optional>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso::mdat {

// What the sensors of a board have measured last: the component's plans say directions alone, and a sensor that stands beside them looks
// past the target unless it knows how far away that is.
struct MeasuredDepth {
  std::optional<double> m;  // median along the sensor frame's z axis of the last scan with returns; none: nothing has returned
};

// Where a sensor stands, and what it can see.
struct SensorMounting {
  Pose T_sensor_own;  // of its own frame in the sensor frame
  double fov_half_x_rad = 0, fov_half_y_rad = 0;

  bool is_aside() const { return !T_sensor_own.p.isZero(0); }
};

// The plan in the sensor's own axes: the smallest rectangle that holds the component's one at that depth (none: far away), cut at the
// field of view. Aimed rays are not part of it. kBadValue: nothing of it lies in the field; `own` is then as it was.
Status plan_from(const SensorMounting& mounting, const std::optional<double>& depth_m, const ScanPlan& plan, ScanPlan& own);

// A ray of the sensor frame, by its place on the tangent plane, in the own one: its direction far away, or the field's end before it.
AimedRay ray_from(const SensorMounting& mounting, const AimedRay& ray);

// A sample as the sensor frame has it. Its point is moved exactly. Of a sensor that stands aside, a ray that met nothing makes no statement
// (kInvalid): it passes the target elsewhere than a ray of that direction from the sensor frame's origin.
RangeSample sample_in_sensor(const SensorMounting& mounting, const RangeSample& sample);

// Hands over the sensor's scans in the sensor frame. Without a mounting it changes nothing, and tells what it measures.
class MountedSensor final : public Sensor {
 public:
  // Keeps both references.
  MountedSensor(Sensor& own, const std::optional<SensorMounting>& mounting, MeasuredDepth& depth)
      : own_(own), mounting_(mounting), depth_(depth) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { own_.abort(); }
  bool can_aim() const override { return own_.can_aim() && !(mounting_ && mounting_->is_aside()); }
  std::uint16_t samples_of(const ScanPlan& plan) const override;
  SensorCounters counters() const override { return own_.counters(); }
  void permit_laser(bool permitted) override { own_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override { own_.use_calibration(calibration); }

 private:
  void note(const RangeSample& sample);

  Sensor& own_;
  std::optional<SensorMounting> mounting_;
  MeasuredDepth& depth_;
  ScanPlan plan_;                 // own
  AimedRays aimed_;               // own
  std::vector<double> depths_m_;  // of the scan's returns
};

}  // namespace lasso::mdat
