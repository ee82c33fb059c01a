// A recording behind the Sensor interface, and what makes one of any sensor.
#pragma once

#include "hal_sim/sensor_recording.hpp"

namespace lasso::sim {

// Passes each call on, and keeps the scans in `recording` as those of sensor `number`.
class SensorRecorder final : public Sensor {
 public:
  SensorRecorder(Sensor& sensor, std::uint8_t number, SensorRecording& recording)
      : sensor_(sensor), number_(number), recording_(recording) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  SensorCounters counters() const override { return sensor_.counters(); }
  bool can_aim() const override { return sensor_.can_aim(); }
  std::uint16_t samples_of(const ScanPlan& plan) const override { return sensor_.samples_of(plan); }
  void permit_laser(bool permitted) override { sensor_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override { sensor_.use_calibration(calibration); }

 private:
  Sensor& sensor_;
  std::uint8_t number_;
  SensorRecording& recording_;
  std::size_t scan_ = 0;  // in the recording, while `open_`
  bool open_ = false;
};

// Plays the scans of one sensor in the recording's order, and from the front again after the last one: what it found then, at the same
// times after the start. It cannot aim: a scan serves a plan of the same pattern, points, number of aimed rays and duration whose centre
// and extents are within kReplayTolerance of the recorded ones, wherever its aimed rays are to go: each sample says where its ray went.
// Others are left out until one serves. A scan that was lost is lost again, for the same reason.
constexpr double kReplayTolerance = 0.02;  // of the pattern's centre and extents, on the tangent plane
class ReplaySensor final : public Sensor {
 public:
  // The recording outlives the sensor.
  ReplaySensor(const SensorRecording& recording, std::uint8_t number) : recording_(recording), number_(number) {}

  // kBadValue: a plan that validate (pattern.hpp) refuses, or that no scan of the recording serves.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { scan_ = nullptr; }
  void permit_laser(bool /*permitted*/) override {}  // it has none

  std::uint32_t unserved() const { return unserved_; }  // plans that are right, for which it has no scan
  std::uint32_t rounds() const { return rounds_; }      // how often it has begun anew, as the recording was at its end

 private:
  const SensorScan* find(const ScanPlan& plan);

  const SensorRecording& recording_;
  std::uint8_t number_;
  std::size_t at_ = 0;  // the scan after the last one that was played
  std::uint32_t rounds_ = 0, unserved_ = 0;
  const SensorScan* scan_ = nullptr;  // that is played
  std::size_t next_ = 0;              // its sample
  DurationUs later_us_ = 0;           // than recorded
};

}  // namespace lasso::sim
