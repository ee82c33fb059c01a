// A head in the processor's own housing, laser camera, LIDAR or TriDAR, behind the Sensor interface: plans and samples pass through memory
// that both see (head_memory.hpp), and one clock times both. What the head says goes by the same numbers, calibrations and checks as over a
// line (driver.hpp), so that the same scan has the same points, bit for bit.
#pragma once

#include <cstdint>

#include "fsw/core/voted.hpp"
#include "fsw/sense/sensor.hpp"
#include "hal_lcs/driver.hpp"
#include "hal_lcs/head_memory.hpp"
#include "hal_lcs/optics.hpp"

namespace lasso::lcs {

class HeadDriver final : public Sensor {
 public:
  // `optics` are valid (an invariant). The memory outlives the driver, and may hold anything: what another driver has left, or what power
  // has. Dark is written at once, and an inhibit is given.
  HeadDriver(HeadMemory& head, const Optics& optics);

  // As Driver's: none at first, in three voted copies that each start repairs. With each call without permission the laser's word is
  // written dark, and the head is given an inhibit unless its status says that it is dark; when permission is taken, always.
  void permit_laser(bool permitted) override;
  void use_calibration(const TriangulationCalibration* calibration) override;

  // kBusy while a scan runs; validate(plan)'s reason; kMissing without permission. The first sample is taken kStartDelayUs later.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  // Bound: out.size() samples.
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  // Damaged frames are those of the head's status.
  SensorCounters counters() const override { return counters_; }

 private:
  struct Scan {
    ScanPlan plan;
    TimeUs first_us = 0;      // of the first sample
    TimeUs last_us = 0;       // of the last sample
    std::uint32_t next = 0;   // sample to hand over
    std::uint32_t there = 0;  // samples that the head has
    std::uint32_t off_plan = 0;
    bool begun = false;      // a status of it has come
    bool forbidden = false;  // permission was taken since its start
  };

  bool laser_permitted() const;
  bool may_be_lit() const;
  void write_permission();
  void show_laser();
  void inhibit();
  std::uint8_t next_sequence() const { return sequence_of(static_cast<std::uint16_t>(commands_ + 1)); }
  void give(const FrameBytes& command);
  Status unanswered(TimeUs now_us) const;
  Status listen(TimeUs now_us);
  std::uint32_t samples_there() const;
  Status take(const CameraStatus& status);
  void hand_over(RangeSample& sample);
  void convert(const RawSample& raw, std::uint16_t ray, TimeUs t_us, RangeSample& sample);

  HeadMemory& head_;
  Optics made_, optics_;          // as it was made, and as they are believed
  Voted<std::uint8_t> laser_{0};  // 1: permitted
  std::uint16_t commands_;        // number of the last one given, modulo 2^16
  std::uint32_t boots_ = 0;       // of the head, as it last said; 0: never
  bool running_ = false;
  Scan scan_;
  SensorCounters counters_;
};

}  // namespace lasso::lcs
