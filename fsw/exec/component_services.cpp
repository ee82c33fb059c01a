// The commands that are neither of modes nor of starts.
#include "fsw/exec/component.hpp"
#include "fsw/link/link_report_rows.hpp"

namespace lasso {
namespace {

constexpr auto kDisabled = codec_of(link_report_rows::kDisabled);
constexpr auto kStoredEvent = codec_of(link_report_rows::kStoredEvent);

ServiceRefusal unless(bool done, ServiceRefusal refusal) { return done ? ServiceRefusal::kNone : refusal; }

}  // namespace

bool Component::may_fire(const Command& command) { return command.hazard == Hazard::kNone || arming_.fire(command.name, command.hazard); }

ServiceRefusal Component::serve(const Command& command, TimeUs now_us) {
  switch (command.kind) {
    case CommandKind::kPing:
      send_pong(now_us);
      break;
    case CommandKind::kHold:
      hold_mode(command.hold.held != 0);
      break;
    case CommandKind::kEnableEvent:
      return enable_event(command.event.event, true);
    case CommandKind::kDisableEvent:
      return enable_event(command.event.event, false);
    case CommandKind::kReportDisabled:
      downlink_.send({kServiceEvent, kSubserviceDisabledEvents}, kDisabled, events_.disabled(), now_us);
      break;
    case CommandKind::kArm:
      return arm(command.armed);
    case CommandKind::kEnableLaser:
      return enable_laser();
    case CommandKind::kInhibitLaser:
      inhibit_laser();
      break;
    case CommandKind::kCorrelateTime:
      correlate_time(command.time);
      break;
    case CommandKind::kReportParameter:
      return report_parameter(command.parameter.parameter, now_us);
    case CommandKind::kSetParameter:
      return set_parameter(command.parameter);
    case CommandKind::kRevertParameters:
      revert_parameters();
      break;
    case CommandKind::kSaveParameters:
      return save_parameters();
    case CommandKind::kRestoreParameters:
      return restore_parameters();
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
      return serve_memory(command, now_us);
    default:
      return serve_structure(command.kind, command.structure);
  }
  return ServiceRefusal::kNone;
}

ServiceRefusal Component::serve_structure(CommandKind kind, const StructureCommand& command) {
  bool exists = true;
  if (kind == CommandKind::kReportStructure) exists = housekeeping_.ask(command.structure);
  if (kind == CommandKind::kStructurePeriod) exists = housekeeping_.set_period(command.structure, command.period_frames);
  if (kind == CommandKind::kEnableStructure) exists = housekeeping_.set_enabled(command.structure, true);
  if (kind == CommandKind::kDisableStructure) exists = housekeeping_.set_enabled(command.structure, false);
  return unless(exists, ServiceRefusal::kNoSuchStructure);
}

ServiceRefusal Component::enable_event(std::uint16_t event, bool enabled) {
  return unless(events_.set_enabled(event, enabled), ServiceRefusal::kNoSuchEvent);
}

ServiceRefusal Component::arm(const CommandName& name) {
  if (!is_hazardous(name)) return ServiceRefusal::kNotHazardous;
  arming_.arm(name);
  events_.raise<EventId::kCommandArmed>(name.service, name.subservice, name.number);
  return ServiceRefusal::kNone;
}

ServiceRefusal Component::enable_laser() {
  if (track_.mode == TrackingMode::kSafe || safe_requested()) return ServiceRefusal::kModeSafe;
  acquisition_.permit_laser(true);
  laser_.set(1);
  events_.raise<EventId::kLaserEnabled>();
  return ServiceRefusal::kNone;
}

// What is armed may be the laser.
void Component::inhibit_laser() {
  arming_.disarm();
  acquisition_.permit_laser(false);
  if (laser_enabled()) events_.raise<EventId::kLaserInhibited>();
  laser_.set(0);
}

// What no two copies say is no permission.
bool Component::laser_enabled() const {
  std::uint8_t enabled = 0;
  return laser_.get(enabled) && enabled != 0;
}

ServiceRefusal Component::change_key(std::uint32_t number) {
  const ServiceRefusal refusal = key_change_.begin(number);
  if (refusal == ServiceRefusal::kNone) events_.raise<EventId::kKeyOnTrial>(number, kKeyTrialFrames);
  return refusal;
}

ServiceRefusal Component::confirm_key(std::uint32_t number) {
  const ServiceRefusal refusal = key_change_.confirm(number);
  if (refusal == ServiceRefusal::kNone) events_.raise<EventId::kKeyConfirmed>(number);
  return refusal;
}

// The laser goes out now, and whatever the board takes to restart.
void Component::reset() {
  inhibit_laser();
  reset_asked_ = true;
  events_.raise<EventId::kResetCommanded>();
}

// Loop bound: kMaxStoredReports.
ServiceRefusal Component::report_stored(const StoredCommand& command, TimeUs now_us) {
  if (!log_.in_use()) return ServiceRefusal::kNoStore;
  const std::uint32_t last = command.last == 0 ? log_.sequence() : command.last;
  std::uint32_t told = 0;
  for (std::uint32_t back = command.count; back > 0; --back) {
    StoredEvent stored;
    if (!log_.read(last - (back - 1), stored)) continue;
    StoredEventTelemetry report;
    report.sequence = stored.sequence;
    report.start = stored.start;
    report.t_us = stored.event.t_us;
    report.event = static_cast<std::uint16_t>(stored.event.id);
    report.severity = static_cast<std::uint8_t>(stored.event.severity);
    report.size = stored.event.size;
    for (std::size_t i = 0; i < kMaxEventBytes; ++i) report.items[i] = stored.event.items[i];
    downlink_.send({kServiceEvent, kSubserviceStoredEvent}, kStoredEvent, report, now_us);
    ++told;
  }
  return unless(told > 0, ServiceRefusal::kNothingStored);
}

// The sensor takes it with its next scan.
ServiceRefusal Component::select_calibration(const CalibrationCommand& choice) {
  TriangulationCalibration calibration;
  if (!images_.active().find_calibration(choice.sensor, choice.calibration, calibration)) return ServiceRefusal::kNoCalibration;
  acquisition_.choose_calibration(choice.sensor, choice.calibration);
  events_.raise<EventId::kCalibrationSelected>(choice.sensor, choice.calibration, calibration.serial);
  return ServiceRefusal::kNone;
}

void Component::correlate_time(const TimeCommand& time) {
  downlink_.correlate_time(time.spacecraft_us - time.component_us);
  events_.raise<EventId::kTimeCorrelated>(downlink_.time_offset_us());
}

}  // namespace lasso
