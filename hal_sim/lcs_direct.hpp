// A head and its calibration without the line between them: the samples that LcsOverLine hands over, to the last count of mirrors and
// detector, without frames, faults or laser.
#pragma once

#include "hal_sim/lcs_head.hpp"
#include "hal_sim/scanner.hpp"

namespace lasso::sim {

class LcsDirect final : public Sensor {
 public:
  // References and exceptions as RaySimulator; the camera's faults are those of its line. The optics are taken to be what they are, unless
  // use_calibration says otherwise.
  LcsDirect(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed, const LcsCamera& camera,
            OtherBodies others = {});

  // As SimulatedScanner; the first sample is taken when the driver of a line would have it taken (lcs::kStartDelayUs).
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { scanner_.abort(); }
  void permit_laser(bool permitted) override { scanner_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override;

 private:
  SimulatedScanner scanner_;
  LcsCamera camera_;
  lcs::Optics made_, optics_;
  ScanPlan plan_;
  std::uint16_t next_ = 0;  // ray
};

}  // namespace lasso::sim
