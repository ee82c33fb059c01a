#include "mdat/run/recording_sensor.hpp"

namespace lasso::mdat {

Status RecordingSensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  const Status status = sensor_.start(plan, t_start_us);
  if (status != Status::kOk) return status;
  scan_id_ = plan.scan_id;
  scans_[scan_id_] = {{}, plan.aimed.size()};
  return status;
}

SensorPoll RecordingSensor::poll(TimeUs now_us, Span<RangeSample> out) {
  const SensorPoll result = sensor_.poll(now_us, out);
  std::vector<RangeSample>& scan = scans_[scan_id_].samples;
  scan.insert(scan.end(), out.begin(), out.begin() + result.count);
  return result;
}

RecordedScan RecordingSensor::take(std::uint32_t scan_id) {
  RecordedScan result;
  const auto found = scans_.find(scan_id);
  if (found != scans_.end()) result = std::move(found->second);
  scans_.erase(scans_.begin(), scans_.upper_bound(scan_id));
  return result;
}

}  // namespace lasso::mdat
