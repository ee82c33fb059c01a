// A sensor as the flight component sees it: whatever scans a plan and hands over samples. Every call returns at once and does bounded
// work. Only the acquisition task calls it, from one thread.
#pragma once

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/sense/range_image.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

struct SensorPoll {
  Status status = Status::kOk;  // kOk; kNoData: idle; kTimeout, kBadCrc, kBadValue, ...: the scan is lost (loss_of, acquisition.hpp)
  std::size_t count = 0;        // samples written, in time order, none twice
  bool complete = false;        // the scan's last sample has been handed over
};

// What a sensor has seen go wrong between its optics and the component, since it was made. Modulo 2^32.
struct SensorCounters {
  std::uint32_t frames = 0;           // that came whole and right
  std::uint32_t damaged_frames = 0;   // that came, but not right
  std::uint32_t missing_frames = 0;   // that never came right, by the sequence of those that did
  std::uint32_t repeated_frames = 0;  // that came again
  std::uint32_t unknown_frames = 0;   // right, and say nothing that is defined
  std::uint32_t strayed = 0;          // samples and answers that belong to no scan under way
  std::uint32_t samples_lost = 0;     // that no frame brought
  std::uint32_t samples_refused = 0;  // that make no statement: out of range, far outside the calibrated volume, saturated, not aimed
  std::uint32_t bad_times = 0;        // samples whose time cannot be
  std::uint32_t off_plan = 0;         // frames whose rays are not those of the plan
  std::uint32_t clock_jumps = 0;
  std::uint32_t restarts = 0;         // of the sensor
  std::uint32_t samples_outside = 0;  // points from beside the calibrated volume, of larger sigma
};

class Sensor {
 public:
  // Arms the scan: its first sample is taken at t_start_us, which is the present time, or as soon after as the hardware can. kBusy while a
  // scan runs, kBadValue when the plan is outside the sensor's limits; the sensor is then as it was.
  virtual Status start(const ScanPlan& plan, TimeUs t_start_us) = 0;
  // Takes the samples acquired by `now_us`, at most out.size(). Samples not taken stay for the next call.
  virtual SensorPoll poll(TimeUs now_us, Span<RangeSample> out) = 0;
  // Ends a scan and discards its samples. No effect when idle.
  virtual void abort() = 0;
  // Whether rays go where a plan wants them. False: the sensor measures all its pixels at once, has no mirrors, and takes no aimed rays.
  virtual bool can_aim() const { return true; }
  // How many samples a scan by this plan, which it has started, has: the plan's points, or fewer where it has not so many pixels there.
  virtual std::uint16_t samples_of(const ScanPlan& plan) const { return plan.points; }
  // Zeros where a sensor has no line on which anything could go wrong.
  virtual SensorCounters counters() const { return {}; }
  // Whether it may light its laser: never before the first permission. Sensors without one, or with one that others look after, ignore it.
  virtual void permit_laser(bool /*permitted*/) {}
  // Between scans: what the mission says of this one's optics, which is valid and copied; nullptr: as it was made. Sensors that state
  // points ignore it.
  virtual void use_calibration(const TriangulationCalibration* /*calibration*/) {}

 protected:
  ~Sensor() = default;  // never deleted through this interface: no operator delete in flight code
};

// The sensors of a board, in the order of their numbers (fsw/mission/mission.hpp). All of them state their samples in one sensor frame.
using SensorBank = FixedVector<Sensor*, kMaxSensors>;
inline SensorBank only(Sensor& sensor) {
  SensorBank bank;
  static_cast<void>(bank.push_back(&sensor));
  return bank;
}

}  // namespace lasso
