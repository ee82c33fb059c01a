// A sensor as the flight component sees it: whatever scans a plan and hands over samples. Every call returns at once and does bounded
// work. Only the acquisition task calls it, from one thread.
//
// What its answers mean. A status that start() or poll() gives instead of kOk loses the scan, for this reason (ScanLoss, acquisition.hpp),
// and counts as this fault (scan_faults.hpp, docs/faults.md):
//
//   status         say it when                                                     loss        fault
//   kMissing       its laser is not permitted, or somebody else inhibits it        inhibited   none
//   kBadValue      the plan is outside of its limits                               refused     none
//   kOverCapacity  there is no room for a command to it                            no_room     none
//   kBusy          an earlier scan still runs                                      busy        sensor_late
//   kTimeout       it does not answer                                              silent      sensor_silent
//   kNoData        it is idle, though a scan was started, or has nothing to give   silent      sensor_silent
//   kTruncated     it ended the scan early                                         stopped     scan_incomplete
//   kBadOrder      it has started anew                                             restarted   scan_incomplete
//   kBadVersion    it is another sensor than the calibration's                     foreign     sensor_corrupt
//   kOffPlan       it scans something else                                         off_plan    sensor_corrupt
//   any other      what it sent cannot be believed                                 other       sensor_corrupt
//
// Samples that are not there yet are no reason to lose a scan: poll() then says kOk, and hands over none.
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
  Status status = Status::kOk;  // kOk: the scan goes on, or has ended with `complete`; otherwise it is lost, as the table says
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
  // Arms the scan: its first sample is taken at t_start_us, which is the present time, or as soon after as the hardware can. kMissing while
  // the laser that it needs is not permitted, kBusy while a scan runs, kBadValue when the plan is outside the sensor's limits; the sensor
  // is then as it was, and dark if it was.
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
  // Whether it may light its laser: not before it is first told so, and no longer once it is told that it may not: what runs then ends,
  // dark, with kMissing. It may be told the same again at any time. A sensor has to say what it does here: one without a laser, or with
  // one that others look after, does nothing.
  virtual void permit_laser(bool permitted) = 0;
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
