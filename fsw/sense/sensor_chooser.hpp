// Which of the mission's sensors takes the next scan: the one whose turn it is by the target's range, if it works. Bands that overlap are
// the hysteresis: within the overlap the sensor in use stays.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/mission/mission.hpp"

namespace lasso {

enum class SensorReason : std::uint8_t {
  kInBand = 0,        // the target's range is within the sensor's band (sensor.use_from_m, use_to_m)
  kRangeUnknown = 1,  // nobody knows the range: the sensors that work look in turn, for 10 scans each
  kOutsideBands = 2,  // within nobody's band; the sensor measures the range (sensor.range_min_m, range_max_m)
  kSubstitute = 3,    // the one whose band it is has failed; the sensor measures the range
  kOutOfRange = 4,    // no sensor that works measures the range
  kAllFailed = 5,     // the one in use goes on
  kBusy = 6,          // what joins several scans is at work on the sensor's: it stays
};

const char* to_string(SensorReason reason);  // never null

struct SensorChoice {
  SensorNumber sensor = 0;
  SensorReason reason = SensorReason::kRangeUnknown;
};

// What the scan is for.
struct SensorNeed {
  std::uint32_t scan_id = 0;
  bool busy = false;         // the sensor may not change
  bool range_known = false;  // of the target's origin
  double range_m = 0;
};

class SensorChooser {
 public:
  // The sensor of the scan. The best of the mission's sensors is one that works and in whose band the range is; then one that works and
  // measures it; then one that works. Among equals the one in use, then the first. Loop bound: the sensors.
  SensorChoice choose(const Mission& mission, const SensorNeed& need);
  // What became of a scan that the sensor was asked for.
  void note(const MissionParameters& parameters, SensorNumber sensor, std::uint32_t scan_id, bool usable);

  // Bit i: sensor i has failed, and rests when scan `scan_id` is planned.
  std::uint8_t failed(std::uint32_t scan_id) const;
  std::uint32_t changes() const { return changes_; }  // of the sensor in use, so far

 private:
  struct Record {
    std::uint32_t lost = 0;         // scans in a row
    std::uint32_t rests_until = 0;  // first scan that it may take again
  };
  bool works(SensorNumber sensor, std::uint32_t scan_id) const { return scan_id >= records_[sensor].rests_until; }
  SensorNumber best(const Mission& mission, const SensorNeed& need) const;
  SensorNumber next_to_look(const Mission& mission, std::uint32_t scan_id);
  SensorReason reason_of(const Mission& mission, const SensorNeed& need, SensorNumber sensor) const;
  int grade(const Mission& mission, const SensorNeed& need, SensorNumber sensor) const;
  void use(SensorNumber sensor);

  Record records_[kMaxSensors];
  SensorNumber in_use_ = 0;
  std::uint32_t looked_ = 0;  // scans in a row for a target of unknown range
  std::uint32_t changes_ = 0;
};

}  // namespace lasso
