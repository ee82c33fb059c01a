#include "fsw/exec/pose_publisher.hpp"

#include "fsw/exec/named_pose.hpp"
#include "fsw/exec/report.hpp"

namespace lasso {

bool PosePublisher::report_overdue() const {
  if (properties(modes_.mode()).says_lost || modes_.changes_overdue()) return true;
  if (modes_.changes_wait() && !scans_.acquired().active) return true;
  return telemetry_.housekeeping().asked(kPoseStructureId);
}

void PosePublisher::send_pose(const TrackStep& step, TimeUs now_us) {
  const ScanInFlight& scan = scans_.estimated();
  PoseTelemetry report = make_report(images_.view(0).mission, step, scan.plan, now_us);
  report.sensor = scan.sensor.sensor;
  report.sensor_reason = static_cast<std::uint8_t>(scan.sensor.reason);
  report.sensors_failed = scans_.chooser().failed(scan.active ? scan.scan_id : executive_.frame());
  if (!step.registration.valid()) ++invalid_frames_;
  if (!telemetry_.housekeeping().due(kPoseStructureId, true)) return modes_.drop_changes();
  set_counters(report);
  modes_.report(report);
  telemetry_.send_structure<kMaxPosePacketBytes, encode_pose>(report, now_us);
}

void PosePublisher::set_counters(PoseTelemetry& report) const {
  report.frames = executive_.frame() + 1;
  report.invalid_frames = invalid_frames_;
  report.lost_scans = scans_.lost_scans();
  report.overruns = scans_.overruns();
  report.sensor_changes = scans_.chooser().changes();
  report.slot_slips = executive_.slips();
  report.dropped_packets = telemetry_.downlink().queue().dropped();
}

void PosePublisher::send_beside(const Registration& registration, TimeUs now_us) {
  Housekeeping& housekeeping = telemetry_.housekeeping();
  const bool news = scans_.estimated().active;
  if (housekeeping.due(kFilterStructureId, news)) {
    const FilterTelemetry report = make_filter_report(scans_.estimated().scan_id, modes_.track().filter, registration.common);
    telemetry_.send_structure<kMaxFilterBytes, encode_filter>(report, now_us);
  }
  if (housekeeping.due(kNamedPoseStructureId, news)) send_named_poses(registration, now_us);
}

// Frames that have decayed are not reported before the scrub has put them right.
void PosePublisher::send_named_poses(const Registration& registration, TimeUs now_us) {
  const ImageSlot& image = images_.active();
  const auto pairs = static_cast<std::uint8_t>(image.named_frames());
  NamedFrame frame;
  for (std::uint8_t i = 0; i < pairs; ++i) {
    if (!image.find_named_frame(i, frame)) continue;
    NamedPoseTelemetry report = make_named_pose_report(frame, registration, modes_.track().filter);
    report.scan_id = scans_.estimated().scan_id;
    report.pair = static_cast<std::uint8_t>(i + 1);
    report.pairs = pairs;
    telemetry_.send_structure<kMaxNamedPoseBytes, encode_named_pose>(report, now_us);
  }
}

}  // namespace lasso
