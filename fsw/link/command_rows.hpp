// The commands, and the rows of their arguments in the order of the wire. A new one is an enumerator and its struct (commands.hpp), its
// rows and its line in kCommands here, and its line in commands.cpp. For the ground: see row.hpp.
#pragma once

#include "cfg/capacities.hpp"
#include "fsw/link/choices.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/event_rows.hpp"
#include "fsw/link/memory_rows.hpp"
#include "fsw/link/packet_row.hpp"
#include "fsw/link/row.hpp"

namespace lasso::command_rows {

constexpr Range kCucRange{0, 4294967296.0 * 1e6};  // 2^32 s

// clang-format off
inline constexpr TypedRow<ModeCommand> kMode[] = {
  make_row<&ModeCommand::mode>(1, "mode", kTrackingMode, "standby, bearing, reacquiring, searching, tracking (from short_range), short_range (from tracking) or safe"),
};
inline constexpr TypedRow<HoldCommand> kHold[] = {
  make_row<&HoldCommand::held>(1, "held", kYesNo, "no mode ends because its frames are used up, and no start is taken but by command"),
};
inline constexpr TypedRow<StartCommand> kStart[] = {
  make_row<&StartCommand::source>(1, "start_source", kStartSource, "from which the pose comes: handover or uplink start at once, navigation waits for its turn"),
  make_row<&StartCommand::t_us>(2, "t_us", "us", kAny, "time at which pose and rates are stated"),
  make_row<&StartCommand::q_sensor_target>(3, "q_sensor_target", "1", kAny, "Hamilton quaternion x, y, z, w of unit length, target to sensor"),
  make_row<&StartCommand::p_sensor_target_m>(4, "p_sensor_target_m", "m", kAny, "target's origin in the sensor frame"),
  make_row<&StartCommand::omega_radps>(5, "omega_radps", "rad/s", kAny, "angular rate, sensor axes"),
  make_row<&StartCommand::v_mps>(6, "v_mps", "m/s", kAny, "velocity of the target's origin, sensor axes"),
  make_row<&StartCommand::covariance>(7, "covariance", "rad,m", kAny, "upper triangle by rows: rotation about target origin, translation; sensor axes"),
};
inline constexpr TypedRow<EventCommand> kEvent[] = {
  make_row<&EventCommand::event>(1, "event", event_rows::Names::kEvent, "the event"),
};
inline constexpr TypedRow<CommandName> kArm[] = {
  make_row<&CommandName::service>(1, "service", "1", kAny, "of the hazardous command"),
  make_row<&CommandName::subservice>(2, "subservice", "1", kAny, "of the hazardous command"),
  make_row<&CommandName::number>(3, "number", "1", kAny, "of the hazardous command, 0 where it has none"),
};
inline constexpr TypedRow<StructureCommand> kStructure[] = {
  make_row<&StructureCommand::structure>(1, "structure", lasso::kStructure, "the structure"),
};
inline constexpr TypedRow<StructureCommand> kPeriod[] = {
  make_row<&StructureCommand::structure>(1, "structure", lasso::kStructure, "the structure"),
  make_row<&StructureCommand::period_frames>(2, "period_frames", "1", kAny, "frames from one report to the next, 0: when there is news"),
};
inline constexpr TypedRow<ParameterCommand> kParameter[] = {
  make_row<&ParameterCommand::parameter>(1, "parameter", "1", kAny, "its id"),
};
inline constexpr TypedRow<ParameterCommand> kSetParameter[] = {
  make_row<&ParameterCommand::parameter>(1, "parameter", "1", kAny, "its id"),
  make_row<&ParameterCommand::value>(2, "value", "as it says", kAny, "new value, in the parameter's unit"),
};
inline constexpr TypedRow<StoredCommand> kStored[] = {
  make_row<&StoredCommand::last>(1, "last", "1", kAny, "sequence number of the last one that is wanted, 0: the newest"),
  make_row<&StoredCommand::count>(2, "count", "1", Range{1, static_cast<double>(kMaxStoredReports)}, "how many that end with it"),
};
inline constexpr TypedRow<CalibrationCommand> kCalibration[] = {
  make_row<&CalibrationCommand::sensor>(1, "sensor", "1", Range{0, kMaxSensors - 1.0}, "0: the mission's [sensor], then the further ones"),
  make_row<&CalibrationCommand::calibration>(2, "calibration", "1", Range{0, kMaxCalibrations - 1.0}, "of those that the active image has for it, from 0 in the mission's order"),
};
inline constexpr TypedRow<KeyCommand> kKey[] = {
  make_row<&KeyCommand::number>(1, "number", "1", Range{1, 4294967295.0}, "of the new key, larger by a small step than that of the key in use; the key itself is never sent"),
};
inline constexpr TypedRow<TimeCommand> kTime[] = {
  make_row<&TimeCommand::component_us>(1, "component_us", "us", kCucRange, "a moment in the component's time, that of the items ..."),
  make_row<&TimeCommand::spacecraft_us>(2, "spacecraft_us", "us", kCucRange, "... and the same moment in spacecraft time"),
};

inline constexpr auto kModeItems = items_of(kMode);
inline constexpr auto kHoldItems = items_of(kHold);
inline constexpr auto kStartItems = items_of(kStart);
inline constexpr auto kEventItems = items_of(kEvent);
inline constexpr auto kArmItems = items_of(kArm);
inline constexpr auto kStructureItems = items_of(kStructure);
inline constexpr auto kPeriodItems = items_of(kPeriod);
inline constexpr auto kTimeItems = items_of(kTime);
inline constexpr auto kParameterItems = items_of(kParameter);
inline constexpr auto kSetParameterItems = items_of(kSetParameter);
inline constexpr auto kStoredItems = items_of(kStored);
inline constexpr auto kCalibrationItems = items_of(kCalibration);
inline constexpr auto kKeyItems = items_of(kKey);
inline constexpr auto kBeginImageItems = items_of(memory_rows::kBegin);
inline constexpr auto kActivateItems = items_of(memory_rows::kActivate);
inline constexpr auto kLoadItems = items_of(memory_rows::kLoad);
inline constexpr auto kRangeItems = items_of(memory_rows::kRange);
// In the order of CommandKind.
inline constexpr PacketRow kCommands[] = {
  {"ping", PacketType::kCommand, kServiceTest, kSubservicePing, false, 0, Span<const ItemRow>(), "asks for the packet pong"},
  {"set_mode", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 1, Span<const ItemRow>(kModeItems.rows),
   "the mode, from the next boundary on"},
  {"set_hold", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 2, Span<const ItemRow>(kHoldItems.rows),
   "holds the mode, from the next boundary on"},
  {"offer_start", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 3, Span<const ItemRow>(kStartItems.rows),
   "a pose to start from"},
  {"enable_event", PacketType::kCommand, kServiceEvent, kSubserviceEnableEvent, false, 0, Span<const ItemRow>(kEventItems.rows),
   "the event is reported again"},
  {"disable_event", PacketType::kCommand, kServiceEvent, kSubserviceDisableEvent, false, 0, Span<const ItemRow>(kEventItems.rows),
   "the event is not reported any more"},
  {"report_disabled_events", PacketType::kCommand, kServiceEvent, kSubserviceReportDisabled, false, 0, Span<const ItemRow>(),
   "asks for the packet disabled_events"},
  {"arm", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 4, Span<const ItemRow>(kArmItems.rows),
   "names the hazardous command that may follow"},
  {"enable_laser", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 5, Span<const ItemRow>(),
   "lets the sensors light their lasers", "", "", Hazard::kOnce},
  {"inhibit_laser", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 6, Span<const ItemRow>(),
   "takes that away, at once"},
  {"enable_structure", PacketType::kCommand, kServiceHousekeeping, kSubserviceEnableStructure, false, 0, Span<const ItemRow>(kStructureItems.rows),
   "the structure is sent again"},
  {"disable_structure", PacketType::kCommand, kServiceHousekeeping, kSubserviceDisableStructure, false, 0, Span<const ItemRow>(kStructureItems.rows),
   "the structure is sent only when it is asked for"},
  {"report_structure", PacketType::kCommand, kServiceHousekeeping, kSubserviceReportStructure, false, 0, Span<const ItemRow>(kStructureItems.rows),
   "asks for the structure once, at the next boundary"},
  {"set_structure_period", PacketType::kCommand, kServiceHousekeeping, kSubserviceStructurePeriod, false, 0, Span<const ItemRow>(kPeriodItems.rows),
   "how often the structure is sent"},
  {"correlate_time", PacketType::kCommand, kServiceTime, kSubserviceCorrelate, false, 0, Span<const ItemRow>(kTimeItems.rows),
   "from now on the headers of telemetry state spacecraft time"},
  {"report_parameter", PacketType::kCommand, kServiceParameter, kSubserviceReportParameter, false, 0, Span<const ItemRow>(kParameterItems.rows),
   "asks for the packet parameter"},
  {"set_parameter", PacketType::kCommand, kServiceParameter, kSubserviceSetParameter, false, 0, Span<const ItemRow>(kSetParameterItems.rows),
   "changes a parameter from the next boundary on"},
  {"revert_parameters", PacketType::kCommand, kServiceParameter, kSubserviceRevertParameters, false, 0, Span<const ItemRow>(),
   "every parameter is the mission image's again, from the next boundary on"},
  {"begin_image", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 32, Span<const ItemRow>(kBeginImageItems.rows),
   "an image for the other buffer is to come; the same one goes on where it stopped"},
  {"check_image", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 33, Span<const ItemRow>(),
   "all of it has come: it is checked and made ready, which takes some time; see the events image_ready and image_refused"},
  {"activate_image", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 34, Span<const ItemRow>(kActivateItems.rows),
   "the other image becomes active at the next boundary", "", "", Hazard::kOnce},
  {"roll_back_image", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 35, Span<const ItemRow>(),
   "the image that was active before becomes active again", "", "", Hazard::kOnce},
  {"load_memory", PacketType::kCommand, kServiceMemory, kSubserviceLoad, false, 0, Span<const ItemRow>(kLoadItems.rows),
   "a part of the image that is being loaded", "", "", Hazard::kRenewed},
  {"dump_memory", PacketType::kCommand, kServiceMemory, kSubserviceDump, false, 0, Span<const ItemRow>(kRangeItems.rows),
   "asks for the packet dumped"},
  {"check_memory", PacketType::kCommand, kServiceMemory, kSubserviceCheck, false, 0, Span<const ItemRow>(kRangeItems.rows),
   "asks for the packet checked"},
  {"reset", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 7, Span<const ItemRow>(),
   "the laser is inhibited, and the board restarts the component at the end of the next frame", "", "", Hazard::kOnce},
  {"save_parameters", PacketType::kCommand, kServiceParameter, kSubserviceSaveParameters, false, 0, Span<const ItemRow>(),
   "the changed parameters go to the store, and hold again after a restart"},
  {"restore_parameters", PacketType::kCommand, kServiceParameter, kSubserviceRestoreParameters, false, 0, Span<const ItemRow>(),
   "the saved parameters take the place of the changed ones, from the next boundary on"},
  {"report_stored_events", PacketType::kCommand, kServiceEvent, kSubserviceReportStored, false, 0, Span<const ItemRow>(kStoredItems.rows),
   "asks for packets stored_event, of this start or of those before"},
  {"select_calibration", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 8, Span<const ItemRow>(kCalibrationItems.rows),
   "the sensor's scans go by this calibration, from the next one on; with an image that is activated, and after a start, they go by the first"},
  {"change_key", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 9, Span<const ItemRow>(kKeyItems.rows),
   "commands may be signed with the key of this number, too, which is on trial until confirm_key; see the events key_on_trial and key_given_up", "", "", Hazard::kOnce},
  {"confirm_key", PacketType::kCommand, kServiceFunction, kSubservicePerform, true, 10, Span<const ItemRow>(kKeyItems.rows),
   "signed with the key on trial: from now on commands need it, and the key before is of no use any more"},
};
// clang-format on

constexpr const PacketRow& row_of(CommandKind kind) { return kCommands[static_cast<std::size_t>(kind)]; }

}  // namespace lasso::command_rows
