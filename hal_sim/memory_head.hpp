// The head that shares memory with the processor in its housing (hal_lcs/head_memory.hpp): it scans the simulated target as the one at the
// end of a line does (lcs_device.hpp), without frames that can be damaged. Time is what it is given: nothing here waits.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal_lcs/head_driver.hpp"
#include "hal_lcs/head_memory.hpp"
#include "hal_sim/lcs_head.hpp"
#include "hal_sim/scanner.hpp"

namespace lasso::sim {

class MemoryHead {
 public:
  // As LcsDevice: keeps references, throws std::invalid_argument. The camera's clock, line and faults are those of a line.
  MemoryHead(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed, const LcsCamera& camera,
             OtherBodies others = {});

  // What was written since the last call was written now: a command is carried out, and all that is measured by now is there. Beats are
  // known from the first call on.
  void run(TimeUs now_us, lcs::HeadMemory& memory);

 private:
  bool lit() const { return permitted_ && !inhibited_; }
  void watch_laser(TimeUs now_us, const lcs::HeadMemory& memory);
  lcs::Result carry_out(const lcs::HeadMemory& memory);
  lcs::Result inhibit(const lcs::Frame& frame);
  lcs::Result start(const lcs::StartCommand& command, const lcs::HeadMemory& memory);
  void measure(TimeUs t_us, lcs::HeadMemory& memory);
  void scan_until(TimeUs now_us, lcs::HeadMemory& memory);
  void tell_status(TimeUs now_us, lcs::HeadMemory& memory) const;

  RaySimulator rays_;
  LcsCamera camera_;
  ScanPlan plan_;
  std::vector<AimedRay> aimed_;
  TimeUs first_us_ = 0;        // of the first sample
  std::uint16_t next_ = 0;     // ray
  std::uint16_t command_ = 0;  // number of the one that it has answered
  bool running_ = false;
  bool permitted_ = false;              // by the word, and the beats
  bool inhibited_ = true;               // from its boot, and by a command, to the next start
  std::optional<std::uint32_t> beats_;  // as last seen
  std::optional<TimeUs> heard_us_;      // when they last moved; never since it was made, which is its boot
};

// The head, the memory and the driver in one sensor, for what runs in simulated time.
class SensorInMemory final : public Sensor {
 public:
  SensorInMemory(MemoryHead& head, const lcs::Optics& optics) : head_(head), driver_(memory_, optics) { head_.run(0, memory_); }

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { driver_.abort(); }
  SensorCounters counters() const override { return driver_.counters(); }
  void permit_laser(bool permitted) override { driver_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override { driver_.use_calibration(calibration); }

 private:
  MemoryHead& head_;
  lcs::HeadMemory memory_;
  lcs::HeadDriver driver_;
};

}  // namespace lasso::sim
