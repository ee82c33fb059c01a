#include "fsw/exec/health_monitor.hpp"

#include "fsw/exec/self_test.hpp"

namespace lasso {
namespace {

constexpr std::size_t kQueueHighBytes = kTelemetryQueueBytes / 10 * 9;

}  // namespace

void HealthMonitor::begin() { health_.failed_tests = static_cast<std::uint8_t>(failed_self_tests()); }

void HealthMonitor::note_clock_jump() {
  see(Fault::kTimeJump);
  ++health_.clock_jumps;
}

void HealthMonitor::feed_watchdog(bool estimation_idle) {
  const bool alive = check_in_.boundary(estimation_idle);
  if (!alive) ++health_.unfed_frames;
  if (watchdog_ != nullptr && alive) watchdog_->feed();
}

void HealthMonitor::see_states(const MissionParameters& parameters) {
  see(Fault::kSlotSlip, executive_.slips() != watched_.slot_slips);
  see(Fault::kMemoryHigh, telemetry_.downlink().queue().size() > kQueueHighBytes);
  const double silence_max_s = parameters.link_silence_max_s;
  see(Fault::kLinkSilent, silence_max_s > 0 && silent_frames_ * parameters.period_s > silence_max_s);
  ++silent_frames_;
  see(Fault::kWatchdogReset, health_.reset_cause > static_cast<std::uint8_t>(ResetCause::kCommanded));
  see(Fault::kSelfTestFailed, health_.failed_tests != 0);
}

FaultReaction HealthMonitor::answer_faults(const MissionParameters& parameters, TimeUs now_us) {
  see_states(parameters);
  const FaultChanges changes = faults_.step(seen_);
  seen_ = FaultSet{};
  report(changes, now_us);
  return changes.reaction;
}

void HealthMonitor::report(const FaultChanges& changes, TimeUs now_us) {
  for (const FaultRow& row : fault_table()) {
    if (changes.confirmed.has(row.fault)) telemetry_.raise<EventId::kFaultConfirmed>(row.fault, row.reaction);
    if (changes.cleared.has(row.fault)) telemetry_.raise<EventId::kFaultCleared>(row.fault);
  }
  const bool news = !changes.confirmed.empty() || !changes.cleared.empty() || executive_.frame() == 0;
  if (!telemetry_.housekeeping().due(kHealthStructureId, news)) return;
  health_.active_faults = faults_.active().bits();
  health_.past_faults = faults_.ever().bits();
  health_.confirmations = faults_.confirmations();
  health_.worst_lateness_us = executive_.worst_lateness_us();
  telemetry_.send_structure<kMaxHealthBytes, encode_health>(health_, now_us);
}

void HealthMonitor::tell_counters(std::uint8_t sensors_failed) {
  const Watched before = watched_;
  watched_.dropped_packets = telemetry_.downlink().queue().dropped();
  watched_.slot_slips = executive_.slips();
  watched_.sensors_failed = sensors_failed;
  if (watched_.dropped_packets != before.dropped_packets) telemetry_.raise<EventId::kPacketsDropped>(watched_.dropped_packets);
  if (watched_.slot_slips != before.slot_slips) telemetry_.raise<EventId::kSlotLate>(watched_.slot_slips);
  // As a difference of words: with two bools compared in the loop, builds by g++ 12.2 at -O2 and -O3 for x86-64 report a failure in each
  // frame, those at -O1 do not; ut/exec tells them apart (AFailureIsToldOnceAndSoIsItsEnd).
  const std::uint32_t failed = watched_.sensors_failed, changed = failed ^ before.sensors_failed;
  for (std::uint32_t i = 0; i < kMaxSensors; ++i) {
    if ((changed >> i & 1U) == 0) continue;
    if ((failed >> i & 1U) != 0) {
      telemetry_.raise<EventId::kSensorFailed>(i);
    } else {
      telemetry_.raise<EventId::kSensorBack>(i);
    }
  }
}

}  // namespace lasso
