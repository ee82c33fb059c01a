#include "fsw/exec/sensor_report.hpp"

namespace lasso {
namespace {

void describe_losses(const ScanTally& tally, SensorTelemetry& out) {
  const auto lost = [&](ScanLoss loss) { return Span<const std::uint32_t>(tally.lost)[static_cast<std::size_t>(loss)]; };
  for (const std::uint32_t count : tally.lost) out.lost += count;
  out.last_loss = static_cast<std::uint8_t>(tally.last_loss);
  out.lost_inhibited = lost(ScanLoss::kInhibited);
  out.lost_no_room = lost(ScanLoss::kNoRoom);
  out.lost_silent = lost(ScanLoss::kSilent);
  out.lost_busy = lost(ScanLoss::kBusy);
  out.lost_refused = lost(ScanLoss::kRefused);
  out.lost_restarted = lost(ScanLoss::kRestarted);
  out.lost_foreign = lost(ScanLoss::kForeign);
  out.lost_stopped = lost(ScanLoss::kStopped);
  out.lost_off_plan = lost(ScanLoss::kOffPlan);
  out.lost_other = lost(ScanLoss::kOther);
  out.lost_unfinished = lost(ScanLoss::kUnfinished);
  out.lost_thin = lost(ScanLoss::kThin);
  out.lost_stuck = lost(ScanLoss::kStuck);
  out.lost_frozen = lost(ScanLoss::kFrozen);
}

void describe_counters(const SensorCounters& counters, SensorTelemetry& out) {
  out.frames = counters.frames;
  out.damaged_frames = counters.damaged_frames;
  out.missing_frames = counters.missing_frames;
  out.repeated_frames = counters.repeated_frames;
  out.unknown_frames = counters.unknown_frames;
  out.strayed = counters.strayed;
  out.samples_lost = counters.samples_lost;
  out.samples_refused = counters.samples_refused;
  out.bad_times = counters.bad_times;
  out.off_plan = counters.off_plan;
  out.clock_jumps = counters.clock_jumps;
  out.restarts = counters.restarts;
  out.samples_outside = counters.samples_outside;
}

}  // namespace

SensorTelemetry make_sensor_report(SensorNumber sensor, const ScanTally& tally, const SensorCounters& counters) {
  SensorTelemetry out;
  out.sensor = sensor;
  out.scans = tally.scans;
  out.calibration = tally.calibration;
  describe_losses(tally, out);
  describe_counters(counters, out);
  return out;
}

std::uint32_t troubles(const SensorTelemetry& report) {
  return report.lost + report.damaged_frames + report.missing_frames + report.repeated_frames + report.unknown_frames + report.strayed +
         report.samples_lost + report.samples_refused + report.bad_times + report.off_plan + report.clock_jumps + report.restarts;
}

}  // namespace lasso
