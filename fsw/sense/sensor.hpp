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
  Status status = Status::kOk;  // kOk; kNoData: idle; kTimeout, kBadCrc, kBadValue, ...: the scan is lost, reason given
  std::size_t count = 0;        // samples written, in time order, none twice
  bool complete = false;        // the scan's last sample has been handed over
};

class Sensor {
 public:
  // Arms the scan: its first sample is taken at t_start_us or as soon after as the hardware can. kBusy while a scan runs, kBadValue when
  // the plan is outside the sensor's limits; the sensor is then as it was.
  virtual Status start(const ScanPlan& plan, TimeUs t_start_us) = 0;
  // Takes the samples acquired by `now_us`, at most out.size(). Samples not taken stay for the next call.
  virtual SensorPoll poll(TimeUs now_us, Span<RangeSample> out) = 0;
  // Ends a scan and discards its samples. No effect when idle.
  virtual void abort() = 0;

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
