// The dictionary: every packet of the link, row by row. Encoders and decoders of the flight component are made from its rows, and so are
// the ground's: `mdat decode`, and the documents of `mdat dictionary`. For the ground: see row.hpp.
#pragma once

#include <cstdint>

#include "fsw/link/command_rows.hpp"
#include "fsw/link/event_rows.hpp"
#include "fsw/link/filter_rows.hpp"
#include "fsw/link/health_rows.hpp"
#include "fsw/link/link_report_rows.hpp"
#include "fsw/link/named_pose_rows.hpp"
#include "fsw/link/packet.hpp"
#include "fsw/link/packet_row.hpp"
#include "fsw/link/pose_rows.hpp"
#include "fsw/link/row.hpp"
#include "fsw/link/sensor_rows.hpp"
#include "fsw/link/telecommand.hpp"

namespace lasso {

// A number of a header: most significant bit first, `bit` counted from the packet's start.
struct HeaderField {
  const char* name;
  std::uint16_t bit;
  std::uint16_t bits;
  const char* meaning;
};

// clang-format off
inline constexpr HeaderField kPrimaryFields[] = {
  {"version", 0, 3, "packet version number, 0"},
  {"type", 3, 1, "0: telemetry, 1: command"},
  {"secondary_header", 4, 1, "there is a secondary header, 1"},
  {"apid", 5, 11, "application process: this component"},
  {"sequence_flags", 16, 2, "unsegmented, 3"},
  {"sequence_count", 18, 14, "counts the packets of the APID, modulo 16384"},
  {"data_length", 32, 16, "octets after this field, minus one"},
};
inline constexpr HeaderField kTelemetryFields[] = {
  {"pus_version", 48, 4, "PUS-C, 2"},
  {"time_status", 52, 4, "quality of the time reference; 0: the component's own clock, 1: spacecraft time, by the last correlate_time"},
  {"service", 56, 8, "service type"},
  {"subservice", 64, 8, "message subtype"},
  {"message_count", 72, 16, "counts the packets of this service and subservice, modulo 65536"},
  {"destination", 88, 16, "whom it is for; 0: everybody"},
  {"time_seconds", 104, 32, "CUC: seconds since the mission's epoch, modulo 2^32"},
  {"time_fraction", 136, 24, "CUC: fraction of a second, in 2^-24 s"},
};
inline constexpr HeaderField kCommandFields[] = {
  {"pus_version", 48, 4, "PUS-C, 2"},
  {"acknowledge", 52, 4, "reports asked for: 1 acceptance, 2 start, 4 progress, 8 completion"},
  {"service", 56, 8, "service type"},
  {"subservice", 64, 8, "message subtype"},
  {"source", 72, 16, "who sends it"},
};

inline constexpr auto kPoseItems = items_of(pose_rows::kRows);
inline constexpr auto kSensorItems = items_of(sensor_report_rows::kRows);
inline constexpr auto kHealthItems = items_of(health_rows::kRows);
inline constexpr auto kFilterItems = items_of(filter_rows::kRows);
inline constexpr auto kNamedPoseItems = items_of(named_pose_rows::kRows);
inline constexpr auto kImageItems = items_of(memory_rows::kImage);
inline constexpr auto kDumpedItems = items_of(memory_rows::kDumped);
inline constexpr auto kCheckedItems = items_of(memory_rows::kChecked);
inline constexpr auto kLinkItems = items_of(link_report_rows::kLink);
inline constexpr auto kDoneItems = items_of(link_report_rows::kDone);
inline constexpr auto kRefusedItems = items_of(link_report_rows::kRefused);
inline constexpr auto kFailedItems = items_of(link_report_rows::kFailed);
inline constexpr auto kParameterValueItems = items_of(link_report_rows::kParameter);
inline constexpr auto kDisabledItems = items_of(link_report_rows::kDisabled);
inline constexpr auto kStoredEventItems = items_of(link_report_rows::kStoredEvent);
inline constexpr PacketRow kTelemetry[] = {
  {"pose", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kPoseStructureId, Span<const ItemRow>(kPoseItems.rows),
   "the navigation output of one frame"},
  {"link", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kLinkStructureId, Span<const ItemRow>(kLinkItems.rows),
   "counters of the link, at the end of a frame in which one of the first four has changed"},
  {"sensor", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kSensorStructureId, Span<const ItemRow>(kSensorItems.rows),
   "how a sensor fares, at the end of a frame in which it lost a scan, or one of its counters of what goes wrong has changed"},
  {"health", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kHealthStructureId, Span<const ItemRow>(kHealthItems.rows),
   "faults and what led to them, at the end of a frame in which one is confirmed or cleared, and of the first"},
  {"image", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kImageStructureId, Span<const ItemRow>(kImageItems.rows),
   "the two mission images and the scrub, at the end of a frame in which an image's state has changed, or something was found"},
  {"filter", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kFilterStructureId, Span<const ItemRow>(kFilterItems.rows),
   "the covariance of the tracking filter, at the end of a frame with a step of the track; disabled until enable_structure"},
  {"named_pose", PacketType::kTelemetry, kServiceHousekeeping, kSubserviceHousekeepingReport, true, kNamedPoseStructureId, Span<const ItemRow>(kNamedPoseItems.rows),
   "pose, rates and covariances between two frames that the mission names, at the end of a frame with a step of the track; none where the image names none"},
  {"dumped", PacketType::kTelemetry, kServiceMemory, kSubserviceDumped, false, 0, Span<const ItemRow>(kDumpedItems.rows),
   "the answer to dump_memory"},
  {"checked", PacketType::kTelemetry, kServiceMemory, kSubserviceChecked, false, 0, Span<const ItemRow>(kCheckedItems.rows),
   "the answer to check_memory"},
  {"accepted", PacketType::kTelemetry, kServiceVerification, kSubserviceAccepted, false, 0, Span<const ItemRow>(kDoneItems.rows),
   "a command is accepted, if it asks for this report"},
  {"refused", PacketType::kTelemetry, kServiceVerification, kSubserviceRefused, false, 0, Span<const ItemRow>(kRefusedItems.rows),
   "a command is refused: it changes nothing"},
  {"started", PacketType::kTelemetry, kServiceVerification, kSubserviceStarted, false, 0, Span<const ItemRow>(kDoneItems.rows),
   "a command that was accepted is begun, if it asks for this report: what it needs is looked at, and it is carried out"},
  {"completed", PacketType::kTelemetry, kServiceVerification, kSubserviceCompleted, false, 0, Span<const ItemRow>(kDoneItems.rows),
   "a command is carried out, if it asks for this report; what concerns modes takes effect at the next boundary"},
  {"failed", PacketType::kTelemetry, kServiceVerification, kSubserviceFailed, false, 0, Span<const ItemRow>(kFailedItems.rows),
   "a command was accepted, but the present state does not allow it: it changes nothing"},
  {"pong", PacketType::kTelemetry, kServiceTest, kSubservicePong, false, 0, Span<const ItemRow>(), "the answer to ping"},
  {"disabled_events", PacketType::kTelemetry, kServiceEvent, kSubserviceDisabledEvents, false, 0, Span<const ItemRow>(kDisabledItems.rows),
   "the answer to report_disabled_events"},
  {"parameter", PacketType::kTelemetry, kServiceParameter, kSubserviceParameterValue, false, 0, Span<const ItemRow>(kParameterValueItems.rows),
   "the answer to report_parameter"},
  {"stored_event", PacketType::kTelemetry, kServiceEvent, kSubserviceStoredEvent, false, 0, Span<const ItemRow>(kStoredEventItems.rows),
   "an event of the store's log, one of those that report_stored_events asks for"},
};
// clang-format on
inline constexpr auto kPackets = joined(kTelemetry, command_rows::kCommands, event_rows::packets());

// Offset of the source or application data, behind the number where there is one.
inline std::size_t data_offset(const PacketRow& packet) {
  const std::size_t header = packet.type == PacketType::kTelemetry ? kPacketHeaderBytes : kCommandHeaderBytes;
  return packet.numbered ? header + kPacketNumberBytes : header;
}

// Offset of an item's first byte from the packet's start; with as many as there are, that of the CRC. Loop bound: the items.
inline std::size_t item_offset(const PacketRow& packet, std::size_t item) {
  std::size_t offset = data_offset(packet);
  for (std::size_t i = 0; i < item; ++i) offset += packet.items[i].size();
  return offset;
}

}  // namespace lasso
