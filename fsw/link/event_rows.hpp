// The events, one row each. A new one is an enumerator (events.hpp), its items and its row here. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/events.hpp"
#include "fsw/link/fault_choices.hpp"
#include "fsw/link/packet_row.hpp"

namespace lasso {

// At most so many in so many frames; what is beyond is counted, and the count reported (events_suppressed). 0: each one is reported.
struct Throttle {
  std::uint16_t most;
  std::uint16_t frames;
};
constexpr Throttle kEach{0, 0};

struct EventRow {
  EventId id = EventId::kNone;
  const char* name = "";
  Severity severity = Severity::kNone;
  Throttle throttle = kEach;
  Span<const ItemRow> items;
  const char* meaning = "";
  const char* cause = "";
  const char* action = "";  // what an operator can do
};

namespace event_rows {

struct Names {
  static const Enumeration kEvent;  // of all events, below
};

// clang-format off
inline constexpr ItemRow kBegun[] = {
  number_item(1, "software_version", WireType::kU32, "1", "major (8 bits), minor (8), patch (16)"),
  number_item(2, "software_build", WireType::kU32, "1", "identifier given by the build, 0: development"),
  number_item(3, "image_crc", WireType::kU32, "1", "CRC-32C of the mission image"),
  choice_item(4, "reset_cause", kResetCause, "why it began"),
};
inline constexpr ItemRow kModeChanged[] = {
  choice_item(1, "from", kTrackingMode, "mode before"),
  choice_item(2, "event", kModeEvent, "why it changed"),
  choice_item(3, "to", kTrackingMode, "mode after"),
};
inline constexpr ItemRow kStartRefused[] = {
  choice_item(1, "start_source", kStartSource, "from which the pose came"),
  choice_item(2, "refusal", kStartRefusal, "why it is refused"),
};
inline constexpr ItemRow kCommandRefused[] = {
  number_item(1, "packet_id", WireType::kU16, "1", "first two bytes of the command, 0 where they are not there"),
  number_item(2, "sequence_control", WireType::kU16, "1", "the two bytes behind them: sequence flags and count"),
  choice_item(3, "fault", kPacketFault, "why it is refused"),
};
inline constexpr ItemRow kCommandFailed[] = {
  number_item(1, "service", WireType::kU8, "1", "of the command"),
  number_item(2, "subservice", WireType::kU8, "1", "of the command"),
  number_item(3, "sequence_control", WireType::kU16, "1", "third and fourth byte of the command: sequence flags and count"),
  choice_item(4, "mode_refusal", kModeRefusal, "why a mode cannot be commanded"),
  choice_item(5, "start_refusal", kStartRefusal, "why a pose to start from is refused"),
  choice_item(6, "service_refusal", kServiceRefusal, "why any other command cannot be carried out"),
};
inline constexpr ItemRow kBytesSkipped[] = {
  number_item(1, "skipped_bytes", WireType::kU32, "1", "bytes from the ground that belonged to no packet, so far"),
};
inline constexpr ItemRow kPacketsDropped[] = {
  number_item(1, "dropped_packets", WireType::kU32, "1", "packets that did not fit into the queue, so far"),
};
inline constexpr ItemRow kSensorChanged[] = {
  number_item(1, "from", WireType::kU8, "1", "sensor before"),
  number_item(2, "to", WireType::kU8, "1", "sensor of the next scan"),
  choice_item(3, "reason", kSensorReason, "why it was chosen"),
};
inline constexpr ItemRow kSensorOnly[] = {
  number_item(1, "sensor", WireType::kU8, "1", "0: the mission's [sensor], then the further ones"),
};
inline constexpr ItemRow kScanLost[] = {
  number_item(1, "sensor", WireType::kU8, "1", "that took it"),
  number_item(2, "scan_id", WireType::kU32, "1", "number of the scan"),
  choice_item(3, "loss", kScanLoss, "why; none: it could not be planned"),
};
inline constexpr ItemRow kEstimateLate[] = {
  number_item(1, "scan_id", WireType::kU32, "1", "number of the scan"),
};
inline constexpr ItemRow kSlotLate[] = {
  number_item(1, "slot_slips", WireType::kU32, "1", "slots that began later than their own length, so far"),
};
inline constexpr ItemRow kPartInconsistent[] = {
  number_item(1, "part", WireType::kU8, "1", "part of the target"),
  number_item(2, "sigmas", WireType::kF32, "1", "how far it is from the one it is farthest from"),
};
inline constexpr ItemRow kEventsSuppressed[] = {
  {1, "event", WireType::kU16, 1, "1", Range{1, static_cast<double>(kEvents) - 1}, &Names::kEvent, "that was raised too often"},
  number_item(2, "suppressed", WireType::kU32, "1", "times that it was not reported"),
};
inline constexpr ItemRow kEventsDropped[] = {
  number_item(1, "dropped", WireType::kU32, "1", "events that were not reported, so far"),
};
inline constexpr ItemRow kArmed[] = {
  number_item(1, "service", WireType::kU8, "1", "of the hazardous command"),
  number_item(2, "subservice", WireType::kU8, "1", "of the hazardous command"),
  number_item(3, "number", WireType::kU16, "1", "of the hazardous command, 0 where it has none"),
};
inline constexpr ItemRow kTimeCorrelated[] = {
  number_item(1, "time_offset_us", WireType::kI64, "us", "spacecraft time minus the component's"),
};
inline constexpr ItemRow kImageReady[] = {
  number_item(1, "image_crc", WireType::kU32, "1", "CRC-32C of the image as received"),
  choice_item(2, "stored", kYesNo, "it is in the store, too"),
};
inline constexpr ItemRow kImageRefused[] = {
  choice_item(1, "status", kStatus, "what is wrong"),
  number_item(2, "table", WireType::kU32, "1", "of the image, 0: header or directory; in the image of part i (from 0) 100 (i + 1) more"),
  number_item(3, "record", WireType::kU32, "1", "the first one that is wrong"),
};
inline constexpr ItemRow kImageActive[] = {
  number_item(1, "image_crc", WireType::kU32, "1", "CRC-32C of the image as received"),
  choice_item(2, "rolled_back", kYesNo, "it is the one that was active before"),
  choice_item(3, "track_kept", kYesNo, "it is one of the same target: its track goes on"),
};
inline constexpr ItemRow kImageConfirmed[] = {
  number_item(1, "image_crc", WireType::kU32, "1", "CRC-32C of the image as received"),
};
inline constexpr ItemRow kMemoryCorrupt[] = {
  choice_item(1, "area", kScrubArea, "what is there"),
  number_item(2, "chunk", WireType::kU32, "1", "16384 bytes each"),
  choice_item(3, "repaired", kYesNo, "it is right again"),
};
inline constexpr ItemRow kFaultConfirmed[] = {
  choice_item(1, "fault", kFault, "that was seen in as many frames running as its row asks for"),
  choice_item(2, "reaction", kFaultReaction, "what the component does"),
};
inline constexpr ItemRow kFaultCleared[] = {
  choice_item(1, "fault", kFault, "that was not seen for as many frames as its row asks for"),
};
inline constexpr ItemRow kParameterChanged[] = {
  number_item(1, "parameter", WireType::kU16, "1", "its id"),
  number_item(2, "value", WireType::kF64, "as it says", "in the parameter's unit"),
};
inline constexpr ItemRow kParametersRestored[] = {
  number_item(1, "parameters", WireType::kU16, "1", "that are changed now"),
  choice_item(2, "refusal", kServiceRefusal, "none, or why what was saved does not hold"),
};

inline constexpr ItemRow kCalibrationSelected[] = {
  number_item(1, "sensor", WireType::kU8, "1", "0: the mission's [sensor], then the further ones"),
  number_item(2, "calibration", WireType::kU8, "1", "of those that the image has for it, from 0"),
  number_item(3, "serial", WireType::kU32, "1", "of the camera that it is for"),
};
inline constexpr ItemRow kKeyOnTrial[] = {
  number_item(1, "number", WireType::kU32, "1", "of the key"),
  number_item(2, "frames", WireType::kU32, "1", "until it is given up"),
};
inline constexpr ItemRow kKey[] = {
  number_item(1, "number", WireType::kU32, "1", "of the key"),
};

inline constexpr EventRow kRows[] = {
  {EventId::kBegun, "begun", Severity::kInformative, kEach, Span<const ItemRow>(kBegun),
   "the component runs", "it was switched on, or reset", ""},
  {EventId::kModeChanged, "mode_changed", Severity::kInformative, kEach, Span<const ItemRow>(kModeChanged),
   "the mode is another one", "the item event says it", "see the table of modes"},
  {EventId::kStartRefused, "start_refused", Severity::kLow, {8, 25}, Span<const ItemRow>(kStartRefused),
   "a pose to start from is refused", "the item refusal says it", "see start_refusal"},
  {EventId::kCommandRefused, "command_refused", Severity::kLow, {8, 25}, Span<const ItemRow>(kCommandRefused),
   "a command is refused: it changes nothing", "the item fault says it", "see packet_fault"},
  {EventId::kCommandFailed, "command_failed", Severity::kLow, kEach, Span<const ItemRow>(kCommandFailed),
   "a command was accepted, but changes nothing", "the present state does not allow it", "see the refusal that is not none"},
  {EventId::kBytesSkipped, "bytes_skipped", Severity::kLow, {1, 25}, Span<const ItemRow>(kBytesSkipped),
   "bytes from the ground belonged to no packet", "noise on the link, or a damaged command", "look at the link; send again what was not answered"},
  {EventId::kPacketsDropped, "packets_dropped", Severity::kMedium, {1, 25}, Span<const ItemRow>(kPacketsDropped),
   "telemetry is lost", "the queue was full: the link takes less than there is to report", "look at the link, or ask for less"},
  {EventId::kSensorChanged, "sensor_changed", Severity::kInformative, {4, 25}, Span<const ItemRow>(kSensorChanged),
   "another sensor takes the scans", "the item reason says it", ""},
  {EventId::kSensorFailed, "sensor_failed", Severity::kMedium, {4, 250}, Span<const ItemRow>(kSensorOnly),
   "a sensor is left out for some frames", "it lost so many scans in a row as sensing.fault_scans says", "look at the sensor"},
  {EventId::kSensorBack, "sensor_back", Severity::kInformative, {4, 250}, Span<const ItemRow>(kSensorOnly),
   "a sensor that had failed may take scans again", "it has rested for 50 scans", ""},
  {EventId::kScanLost, "scan_lost", Severity::kLow, {4, 25}, Span<const ItemRow>(kScanLost),
   "a scan gives no pose", "the item loss says it", "see scan_loss, and the packet sensor"},
  {EventId::kEstimateLate, "estimate_late", Severity::kMedium, {4, 25}, Span<const ItemRow>(kEstimateLate),
   "a frame is reported without a pose", "the estimate of its scan was not done at its boundary", "look at the processor's load; give the period more time"},
  {EventId::kSlotLate, "slot_late", Severity::kLow, {1, 25}, Span<const ItemRow>(kSlotLate),
   "a slot began later than its own length", "the processor was busy elsewhere", "look at the processor's load"},
  {EventId::kPartInconsistent, "part_inconsistent", Severity::kLow, {4, 25}, Span<const ItemRow>(kPartInconsistent),
   "a part of the target disagrees with the others", "it has moved, or its scans deceive", "look at the part; leave it out of the mission image if it has moved"},
  {EventId::kEventsSuppressed, "events_suppressed", Severity::kInformative, kEach, Span<const ItemRow>(kEventsSuppressed),
   "an event happened more often than it was reported", "its row allows so many in so many frames", "see that event"},
  {EventId::kEventsDropped, "events_dropped", Severity::kLow, {1, 25}, Span<const ItemRow>(kEventsDropped),
   "events are lost", "more were raised in a frame than it holds", ""},
  {EventId::kCommandArmed, "command_armed", Severity::kInformative, kEach, Span<const ItemRow>(kArmed),
   "a hazardous command may be fired", "the command arm", "fire it, or let it expire"},
  {EventId::kArmExpired, "arm_expired", Severity::kLow, kEach, Span<const ItemRow>(kArmed),
   "a hazardous command that was armed did not come", "it was not sent in time, or was lost", "arm it again"},
  {EventId::kLaserEnabled, "laser_enabled", Severity::kInformative, kEach, Span<const ItemRow>(),
   "the sensors may light their lasers", "the command enable_laser", ""},
  {EventId::kLaserInhibited, "laser_inhibited", Severity::kInformative, kEach, Span<const ItemRow>(),
   "the sensors may not light their lasers any more", "the command inhibit_laser, or safe mode", "arm and send enable_laser"},
  {EventId::kTimeCorrelated, "time_correlated", Severity::kInformative, kEach, Span<const ItemRow>(kTimeCorrelated),
   "headers of telemetry state spacecraft time", "the command correlate_time", ""},
  {EventId::kImageReady, "image_ready", Severity::kInformative, kEach, Span<const ItemRow>(kImageReady),
   "the image in the other buffer can be made active", "it has been checked", "activate it"},
  {EventId::kImageRefused, "image_refused", Severity::kLow, kEach, Span<const ItemRow>(kImageRefused),
   "the image in the other buffer is wrong", "the item status says it; or it has decayed in memory", "compile it with this version, and load it again"},
  {EventId::kImageActive, "image_active", Severity::kInformative, kEach, Span<const ItemRow>(kImageActive),
   "the other image is active now", "it was commanded; or the new one has failed its first scans", ""},
  {EventId::kImageConfirmed, "image_confirmed", Severity::kInformative, kEach, Span<const ItemRow>(kImageConfirmed),
   "the active image has given valid poses: it is what the next start begins with", "its first scans", ""},
  {EventId::kMemoryCorrupt, "memory_corrupt", Severity::kMedium, {8, 250}, Span<const ItemRow>(kMemoryCorrupt),
   "memory that must not change has changed", "a flipped bit", "where it is not repaired: load the image again, or restart"},
  {EventId::kFaultConfirmed, "fault_confirmed", Severity::kMedium, {8, 25}, Span<const ItemRow>(kFaultConfirmed),
   "a fault is confirmed, and answered", "see the table of faults", "see the table of faults"},
  {EventId::kFaultCleared, "fault_cleared", Severity::kInformative, {8, 25}, Span<const ItemRow>(kFaultCleared),
   "a fault is over", "it was not seen any more", ""},
  {EventId::kParameterChanged, "parameter_changed", Severity::kInformative, kEach, Span<const ItemRow>(kParameterChanged),
   "a parameter has another value from the next boundary on", "the command set_parameter", ""},
  {EventId::kParametersReverted, "parameters_reverted", Severity::kInformative, kEach, Span<const ItemRow>(),
   "every parameter is the mission image's again", "the command revert_parameters", ""},
  {EventId::kParametersRepaired, "parameters_repaired", Severity::kLow, {4, 25}, Span<const ItemRow>(),
   "one of the two copies of the changed parameters was damaged, and is repaired", "a bit flip in memory", ""},
  {EventId::kParametersLost, "parameters_lost", Severity::kHigh, {4, 25}, Span<const ItemRow>(),
   "both copies of the changed parameters were damaged: every parameter is the mission image's again", "bit flips in memory", "set the parameters again"},
  {EventId::kParametersSaved, "parameters_saved", Severity::kInformative, kEach, Span<const ItemRow>(),
   "the changed parameters are in the store: they hold again after a restart", "the command save_parameters", ""},
  {EventId::kParametersRestored, "parameters_restored", Severity::kInformative, kEach, Span<const ItemRow>(kParametersRestored),
   "the saved parameters took the place of the changed ones, or could not", "a start, or the command restore_parameters", "where they are refused: set them again, and save them"},
  {EventId::kResetCommanded, "reset_commanded", Severity::kInformative, kEach, Span<const ItemRow>(),
   "the board restarts the component at the end of this frame", "the command reset", ""},
  {EventId::kCalibrationSelected, "calibration_selected", Severity::kInformative, kEach, Span<const ItemRow>(kCalibrationSelected),
   "the sensor's scans go by this calibration from the next one on", "the command select_calibration", ""},
  {EventId::kKeyOnTrial, "key_on_trial", Severity::kInformative, kEach, Span<const ItemRow>(kKeyOnTrial),
   "commands may be signed with this key, too, until it is confirmed or given up", "the command change_key", "send confirm_key, signed with it"},
  {EventId::kKeyConfirmed, "key_confirmed", Severity::kInformative, kEach, Span<const ItemRow>(kKey),
   "commands need this key from now on", "the command confirm_key", ""},
  {EventId::kKeyGivenUp, "key_given_up", Severity::kLow, kEach, Span<const ItemRow>(kKey),
   "the key on trial is of no use any more: commands need the one before", "no confirm_key in time", "look at the new key of the ground; send change_key again"},
};
// clang-format on

constexpr bool in_order() {
  std::size_t number = 0;
  std::size_t wrong = 0;  // bits by which any number is another one
  for (const EventRow& row : kRows) wrong |= static_cast<std::size_t>(row.id) ^ ++number;
  return (wrong | ((number + 1) ^ kEvents)) == 0;
}
static_assert(in_order(), "a row for each event, in the order of their numbers");

constexpr const EventRow& row_of(EventId id) { return kRows[static_cast<std::size_t>(id) - 1]; }

struct Choices {
  Choice all[kEvents] = {};
};
constexpr Choices choices() {
  Choices choices;
  choices.all[0] = {"none", "no event"};
  for (std::size_t i = 1; i < kEvents; ++i) choices.all[i] = {kRows[i - 1].name, kRows[i - 1].meaning, kRows[i - 1].action};
  return choices;
}
inline constexpr Choices kChoices = choices();
inline constexpr Enumeration Names::kEvent{"event", Span<const Choice>(kChoices.all)};

constexpr PacketTable<kEvents - 1> packets() {
  PacketTable<kEvents - 1> table;
  for (std::size_t i = 0; i + 1 < kEvents; ++i) {
    const EventRow& row = kRows[i];
    table.rows[i] = {row.name,      PacketType::kTelemetry,
                     kServiceEvent, static_cast<std::uint8_t>(row.severity),
                     true,          static_cast<std::uint16_t>(row.id),
                     row.items,     row.meaning,
                     row.cause,     row.action};
  }
  return table;
}

}  // namespace event_rows
}  // namespace lasso
