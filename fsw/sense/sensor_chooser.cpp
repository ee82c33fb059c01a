#include "fsw/sense/sensor_chooser.hpp"

namespace lasso {
namespace {

static_assert(kMaxSensors <= 8, "a bit of failed() each");

// Scans for which a sensor that has failed rests. One scan tells whether it is back, so that one that stays broken costs a fiftieth of the
// scans.
constexpr std::uint32_t kSensorRestScans = 50;
// Scans for which a sensor looks for a target of unknown range before the next one does. A bearing needs one scan that sees the target and
// a search three bearings (fsw/mode/searcher.hpp); ten leave room for lost scans, and four sensors have all looked within forty.
constexpr std::uint32_t kLookScans = 10;

// Grades of a sensor for a scan.
constexpr int kFailed = 0;
constexpr int kWorks = 1;
constexpr int kMeasures = 2;
constexpr int kInItsBand = 3;

bool has_turn(const SensorParameters& sensor, double range_m) { return range_m >= sensor.use_from_m && range_m <= sensor.use_to_m; }

bool measures(const SensorParameters& sensor, double range_m) { return range_m >= sensor.range_min_m && range_m <= sensor.range_max_m; }

SensorNumber count_of(const Mission& mission) { return static_cast<SensorNumber>(mission.sensors.size()); }

constexpr const char* kReasonNames[] = {"in_band", "range_unknown", "outside_bands", "substitute", "out_of_range", "all_failed", "busy"};

}  // namespace

const char* to_string(SensorReason reason) {
  const auto index = static_cast<std::size_t>(reason);
  return index < sizeof(kReasonNames) / sizeof(kReasonNames[0]) ? kReasonNames[index] : "unknown";
}

int SensorChooser::grade(const Mission& mission, const SensorNeed& need, SensorNumber sensor) const {
  if (!works(sensor, need.scan_id)) return kFailed;
  const SensorParameters& parameters = mission.sensors[sensor];
  if (has_turn(parameters, need.range_m)) return kInItsBand;
  return measures(parameters, need.range_m) ? kMeasures : kWorks;
}

SensorNumber SensorChooser::best(const Mission& mission, const SensorNeed& need) const {
  SensorNumber chosen = in_use_;
  for (SensorNumber i = 0; i < count_of(mission); ++i) {
    if (grade(mission, need, i) > grade(mission, need, chosen)) chosen = i;
  }
  return chosen;
}

// The one in use until it has looked for long enough, or fails; then the next one that works.
SensorNumber SensorChooser::next_to_look(const Mission& mission, std::uint32_t scan_id) {
  ++looked_;
  if (works(in_use_, scan_id) && looked_ <= kLookScans) return in_use_;
  looked_ = 1;
  const SensorNumber count = count_of(mission);
  for (SensorNumber i = 1; i < count; ++i) {
    const auto next = static_cast<SensorNumber>((in_use_ + i) % count);
    if (works(next, scan_id)) return next;
  }
  return in_use_;
}

SensorReason SensorChooser::reason_of(const Mission& mission, const SensorNeed& need, SensorNumber sensor) const {
  const int reached = grade(mission, need, sensor);
  if (reached == kFailed) return SensorReason::kAllFailed;
  if (!need.range_known) return SensorReason::kRangeUnknown;
  if (reached == kInItsBand) return SensorReason::kInBand;
  if (reached == kWorks) return SensorReason::kOutOfRange;
  for (const SensorParameters& other : mission.sensors) {
    if (has_turn(other, need.range_m)) return SensorReason::kSubstitute;  // it would have been taken if it worked
  }
  return SensorReason::kOutsideBands;
}

void SensorChooser::use(SensorNumber sensor) {
  if (sensor == in_use_) return;
  in_use_ = sensor;
  ++changes_;
}

SensorChoice SensorChooser::choose(const Mission& mission, const SensorNeed& need) {
  if (need.busy) return {in_use_, SensorReason::kBusy};
  if (need.range_known) looked_ = 0;
  use(need.range_known ? best(mission, need) : next_to_look(mission, need.scan_id));
  return {in_use_, reason_of(mission, need, in_use_)};
}

void SensorChooser::note(const MissionParameters& p, SensorNumber sensor, std::uint32_t scan_id, bool usable) {
  Record& record = records_[sensor];
  record.lost = usable ? 0 : record.lost + 1;
  if (static_cast<double>(record.lost) < p.fault_scans) return;
  record.rests_until = scan_id + 1 + kSensorRestScans;
}

std::uint8_t SensorChooser::failed(std::uint32_t scan_id) const {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kMaxSensors; ++i) bits |= works(static_cast<SensorNumber>(i), scan_id) ? 0U : 1U << i;
  return static_cast<std::uint8_t>(bits);
}

}  // namespace lasso
