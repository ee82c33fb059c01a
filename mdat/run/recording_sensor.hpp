// A sensor that remembers what it handed over, scan by scan, for reports, bounds and recordings. It changes nothing on the way.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "fsw/sense/sensor.hpp"

namespace lasso::mdat {

struct RecordedScan {
  std::vector<RangeSample> samples;
  std::size_t aimed = 0;  // of them, in the middle
};

class RecordingSensor final : public Sensor {
 public:
  explicit RecordingSensor(Sensor& sensor) : sensor_(sensor) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { sensor_.abort(); }
  SensorCounters counters() const override { return sensor_.counters(); }
  bool can_aim() const override { return sensor_.can_aim(); }
  std::uint16_t samples_of(const ScanPlan& plan) const override { return sensor_.samples_of(plan); }
  void permit_laser(bool permitted) override { sensor_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override { sensor_.use_calibration(calibration); }

  // A scan, which is then forgotten; empty for one that never was.
  RecordedScan take(std::uint32_t scan_id);

 private:
  Sensor& sensor_;
  std::uint32_t scan_id_ = 0;
  std::map<std::uint32_t, RecordedScan> scans_;
};

}  // namespace lasso::mdat
