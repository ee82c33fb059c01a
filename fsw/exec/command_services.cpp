#include "fsw/exec/command_services.hpp"

#include "fsw/link/link_report.hpp"
#include "fsw/link/link_report_rows.hpp"

namespace lasso {
namespace {

constexpr auto kDisabled = codec_of(link_report_rows::kDisabled);
constexpr auto kStoredEvent = codec_of(link_report_rows::kStoredEvent);

ServiceRefusal unless(bool done, ServiceRefusal refusal) { return done ? ServiceRefusal::kNone : refusal; }

StoredEventTelemetry report_of(const StoredEvent& stored) {
  StoredEventTelemetry report;
  report.sequence = stored.sequence;
  report.start = stored.start;
  report.t_us = stored.event.t_us;
  report.event = static_cast<std::uint16_t>(stored.event.id);
  report.severity = static_cast<std::uint8_t>(stored.event.severity);
  report.size = stored.event.size;
  for (std::size_t i = 0; i < kMaxEventBytes; ++i) report.items[i] = stored.event.items[i];
  return report;
}

}  // namespace

ServiceRefusal CommandServices::serve(const Command& command, TimeUs now_us) {
  switch (command.kind) {
    case CommandKind::kPing:
      send_pong(now_us);
      break;
    case CommandKind::kHold:
      modes_.hold_mode(command.hold.held != 0);
      break;
    case CommandKind::kEnableEvent:
      return enable_event(command.event.event, true);
    case CommandKind::kDisableEvent:
      return enable_event(command.event.event, false);
    case CommandKind::kReportDisabled:
      report_disabled(now_us);
      break;
    case CommandKind::kArm:
      return context_.interlocks.arm(command.armed);
    case CommandKind::kEnableLaser:
      return enable_laser();
    case CommandKind::kInhibitLaser:
      context_.interlocks.inhibit_laser();
      break;
    case CommandKind::kCorrelateTime:
      correlate_time(command.time);
      break;
    case CommandKind::kReportParameter:
      return parameters_.report(command.parameter.parameter, now_us);
    case CommandKind::kSetParameter:
      return parameters_.set(command.parameter);
    case CommandKind::kRevertParameters:
      parameters_.revert();
      break;
    case CommandKind::kSaveParameters:
      return parameters_.save();
    case CommandKind::kRestoreParameters:
      return parameters_.restore();
    case CommandKind::kReset:
      reset();
      break;
    case CommandKind::kReportStored:
      return report_stored(command.stored, now_us);
    case CommandKind::kSelectCalibration:
      return select_calibration(command.calibration);
    case CommandKind::kChangeKey:
      return change_key(command.key.number);
    case CommandKind::kConfirmKey:
      return confirm_key(command.key.number);
    case CommandKind::kBeginImage:
    case CommandKind::kCheckImage:
    case CommandKind::kActivateImage:
    case CommandKind::kRollBackImage:
    case CommandKind::kLoadMemory:
    case CommandKind::kDumpMemory:
    case CommandKind::kCheckMemory:
      return images_.serve(command, now_us);
    default:
      return serve_structure(command.kind, command.structure);
  }
  return ServiceRefusal::kNone;
}

void CommandServices::pass_boundary() {
  if (key_change_.pass_boundary()) context_.telemetry.raise<EventId::kKeyGivenUp>(key_change_.number());
}

ServiceRefusal CommandServices::serve_structure(CommandKind kind, const StructureCommand& command) {
  Housekeeping& housekeeping = context_.telemetry.housekeeping();
  bool exists = true;
  if (kind == CommandKind::kReportStructure) exists = housekeeping.ask(command.structure);
  if (kind == CommandKind::kStructurePeriod) exists = housekeeping.set_period(command.structure, command.period_frames);
  if (kind == CommandKind::kEnableStructure) exists = housekeeping.set_enabled(command.structure, true);
  if (kind == CommandKind::kDisableStructure) exists = housekeeping.set_enabled(command.structure, false);
  return unless(exists, ServiceRefusal::kNoSuchStructure);
}

ServiceRefusal CommandServices::enable_event(std::uint16_t event, bool enabled) {
  return unless(context_.telemetry.events().set_enabled(event, enabled), ServiceRefusal::kNoSuchEvent);
}

void CommandServices::report_disabled(TimeUs now_us) {
  Telemetry& telemetry = context_.telemetry;
  telemetry.downlink().send({kServiceEvent, kSubserviceDisabledEvents}, kDisabled, telemetry.events().disabled(), now_us);
}

void CommandServices::send_pong(TimeUs now_us) {
  Downlink& downlink = context_.telemetry.downlink();
  std::uint8_t packet[kMaxLinkReportBytes];
  downlink.send_answer({packet, encode_pong(downlink.next_header({kServiceTest, kSubservicePong}, now_us), Bytes(packet))});
}

ServiceRefusal CommandServices::enable_laser() {
  if (modes_.mode() == TrackingMode::kSafe || modes_.safe_requested()) return ServiceRefusal::kModeSafe;
  context_.interlocks.enable_laser();
  return ServiceRefusal::kNone;
}

ServiceRefusal CommandServices::change_key(std::uint32_t number) {
  const ServiceRefusal refusal = key_change_.begin(number);
  if (refusal == ServiceRefusal::kNone) context_.telemetry.raise<EventId::kKeyOnTrial>(number, kKeyTrialFrames);
  return refusal;
}

ServiceRefusal CommandServices::confirm_key(std::uint32_t number) {
  const ServiceRefusal refusal = key_change_.confirm(number);
  if (refusal == ServiceRefusal::kNone) context_.telemetry.raise<EventId::kKeyConfirmed>(number);
  return refusal;
}

// The laser goes out now: the board may take some frames to restart.
void CommandServices::reset() {
  context_.interlocks.inhibit_laser();
  reset_asked_ = true;
  context_.telemetry.raise<EventId::kResetCommanded>();
}

// Loop bound: kMaxStoredReports.
ServiceRefusal CommandServices::report_stored(const StoredCommand& command, TimeUs now_us) {
  const StoredLog& log = context_.telemetry.stored_log();
  if (!log.in_use()) return ServiceRefusal::kNoStore;
  const std::uint32_t last = command.last == 0 ? log.sequence() : command.last;
  std::uint32_t reported = 0;
  for (std::uint32_t back = command.count; back > 0; --back) {
    StoredEvent stored;
    if (!log.read(last - (back - 1), stored)) continue;
    context_.telemetry.downlink().send({kServiceEvent, kSubserviceStoredEvent}, kStoredEvent, report_of(stored), now_us);
    ++reported;
  }
  return unless(reported > 0, ServiceRefusal::kNothingStored);
}

// The sensor takes it with its next scan.
ServiceRefusal CommandServices::select_calibration(const CalibrationCommand& choice) {
  TriangulationCalibration calibration;
  if (!context_.images.active().find_calibration(choice.sensor, choice.calibration, calibration)) return ServiceRefusal::kNoCalibration;
  acquisition_.choose_calibration(choice.sensor, choice.calibration);
  context_.telemetry.raise<EventId::kCalibrationSelected>(choice.sensor, choice.calibration, calibration.serial);
  return ServiceRefusal::kNone;
}

void CommandServices::correlate_time(const TimeCommand& time) {
  Downlink& downlink = context_.telemetry.downlink();
  downlink.correlate_time(time.spacecraft_us - time.component_us);
  context_.telemetry.raise<EventId::kTimeCorrelated>(downlink.time_offset_us());
}

}  // namespace lasso
