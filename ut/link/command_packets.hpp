// Packets as the ground sends them, and telemetry as it reads it.
#pragma once

#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/link/command_rows.hpp"
#include "fsw/link/packet.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

using Stream = std::vector<std::uint8_t>;

inline ConstBytes view(const Stream& stream) { return {stream.data(), stream.size()}; }
inline void append(Stream& stream, const Stream& more) { stream.insert(stream.end(), more.begin(), more.end()); }

inline void repair_crc(Stream& packet) {
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), packet.size() - kPacketTrailerBytes));
  packet[packet.size() - 2] = static_cast<std::uint8_t>(crc >> 8);
  packet[packet.size() - 1] = static_cast<std::uint8_t>(crc & 0xFF);
}

inline Stream finished(ByteWriter& writer, Stream& packet) {
  packet.resize(finish_packet(writer, Bytes(packet.data(), packet.size())));
  EXPECT_FALSE(packet.empty());
  return packet;
}

// A whole packet, as it would be of another component, or for it.
inline Stream for_apid(Stream packet, std::uint16_t apid) {
  packet[0] = static_cast<std::uint8_t>((packet[0] & 0xF8) | apid >> 8);
  packet[1] = static_cast<std::uint8_t>(apid & 0xFF);
  repair_crc(packet);
  return packet;
}

// Begins a packet of this kind.
inline void begin(CommandKind kind, std::uint16_t count, ByteWriter& writer) {
  const PacketRow& row = command_rows::row_of(kind);
  CommandHeader header;
  header.sequence_count = count;
  header.service = row.service;
  header.subservice = row.subservice;
  begin_command(header, writer);
  if (row.numbered) writer.u16(row.number);
}

inline Stream plain_packet(CommandKind kind, std::uint16_t count = 0) {
  Stream packet(kMaxCommandBytes);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin(kind, count, writer);
  return finished(writer, packet);
}

template <class Arguments, std::size_t kRows>
Stream command_packet(CommandKind kind, const TypedRow<Arguments> (&rows)[kRows], const Arguments& arguments, std::uint16_t count = 0) {
  Stream packet(kMaxCommandBytes);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin(kind, count, writer);
  codec_of(rows).write(arguments, writer);
  return finished(writer, packet);
}

inline Stream ping(std::uint16_t count = 0) { return plain_packet(CommandKind::kPing, count); }
inline Stream set_mode(std::uint8_t mode, std::uint16_t count = 0) {
  return command_packet(CommandKind::kMode, command_rows::kMode, ModeCommand{mode}, count);
}
inline Stream set_hold(std::uint8_t held, std::uint16_t count = 0) {
  return command_packet(CommandKind::kHold, command_rows::kHold, HoldCommand{held}, count);
}
inline Stream offer_start(const StartCommand& start, std::uint16_t count = 0) {
  return command_packet(CommandKind::kStart, command_rows::kStart, start, count);
}
inline Stream enable_event(std::uint16_t event, std::uint16_t count = 0) {
  return command_packet(CommandKind::kEnableEvent, command_rows::kEvent, EventCommand{event}, count);
}
inline Stream disable_event(std::uint16_t event, std::uint16_t count = 0) {
  return command_packet(CommandKind::kDisableEvent, command_rows::kEvent, EventCommand{event}, count);
}
inline Stream report_disabled(std::uint16_t count = 0) { return plain_packet(CommandKind::kReportDisabled, count); }

inline Stream arm(const CommandName& name, std::uint16_t count = 0) {
  return command_packet(CommandKind::kArm, command_rows::kArm, name, count);
}
inline Stream arm(CommandKind kind, std::uint16_t count = 0) {
  const PacketRow& row = command_rows::row_of(kind);
  return arm({row.service, row.subservice, row.number}, count);
}
inline Stream of_structure(CommandKind kind, std::uint16_t structure, std::uint16_t count = 0) {
  return command_packet(kind, command_rows::kStructure, StructureCommand{structure, 0}, count);
}
inline Stream set_period(std::uint16_t structure, std::uint16_t frames, std::uint16_t count = 0) {
  return command_packet(CommandKind::kStructurePeriod, command_rows::kPeriod, StructureCommand{structure, frames}, count);
}
inline Stream select_calibration(const CalibrationCommand& choice, std::uint16_t count = 0) {
  return command_packet(CommandKind::kSelectCalibration, command_rows::kCalibration, choice, count);
}
// kChangeKey, kConfirmKey.
inline Stream of_key(CommandKind kind, std::uint32_t number, std::uint16_t count = 0) {
  return command_packet(kind, command_rows::kKey, KeyCommand{number}, count);
}
inline Stream set_parameter(std::uint16_t id, double value, std::uint16_t count = 0) {
  return command_packet(CommandKind::kSetParameter, command_rows::kSetParameter, ParameterCommand{id, value}, count);
}
inline Stream report_parameter(std::uint16_t id, std::uint16_t count = 0) {
  return command_packet(CommandKind::kReportParameter, command_rows::kParameter, ParameterCommand{id, 0}, count);
}
inline Stream correlate_time(TimeUs component_us, TimeUs spacecraft_us, std::uint16_t count = 0) {
  return command_packet(CommandKind::kCorrelateTime, command_rows::kTime, TimeCommand{component_us, spacecraft_us}, count);
}

inline Stream report_stored(std::uint32_t last, std::uint8_t count_of_events, std::uint16_t count = 0) {
  return command_packet(CommandKind::kReportStored, command_rows::kStored, StoredCommand{last, count_of_events}, count);
}
inline Stream begin_image(std::uint32_t bytes, std::uint32_t crc, std::uint16_t count = 0) {
  return command_packet(CommandKind::kBeginImage, memory_rows::kBegin, ImageCommand{bytes, crc}, count);
}
inline Stream activate_image(std::uint32_t crc, std::uint16_t count = 0) {
  return command_packet(CommandKind::kActivateImage, memory_rows::kActivate, ImageCommand{0, crc}, count);
}
inline Stream load_memory(const LoadCommand& load, std::uint16_t count = 0) {
  return command_packet(CommandKind::kLoadMemory, memory_rows::kLoad, load, count);
}
inline Stream of_memory(CommandKind kind, const MemoryCommand& range, std::uint16_t count = 0) {
  return command_packet(kind, memory_rows::kRange, range, count);
}

// One of each kind, with arguments that are in range.
inline std::vector<Stream> every_command() {
  return {ping(),
          set_mode(5),
          set_hold(1),
          offer_start(StartCommand{}),
          enable_event(2),
          disable_event(3),
          report_disabled(),
          arm(CommandKind::kEnableLaser),
          plain_packet(CommandKind::kEnableLaser),
          plain_packet(CommandKind::kInhibitLaser),
          of_structure(CommandKind::kEnableStructure, 1),
          of_structure(CommandKind::kDisableStructure, 1),
          of_structure(CommandKind::kReportStructure, 2),
          set_period(1, 5),
          correlate_time(1, 2),
          report_parameter(3),
          set_parameter(3, 0.5),
          plain_packet(CommandKind::kRevertParameters),
          begin_image(1000, 0x12345678),
          plain_packet(CommandKind::kCheckImage),
          activate_image(0x12345678),
          plain_packet(CommandKind::kRollBackImage),
          load_memory({0, 256, 3, {1, 2, 3}}),
          of_memory(CommandKind::kDumpMemory, {1, 4096, 100}),
          of_memory(CommandKind::kCheckMemory, {2, 0, 16384}),
          plain_packet(CommandKind::kReset),
          plain_packet(CommandKind::kSaveParameters),
          plain_packet(CommandKind::kRestoreParameters),
          report_stored(9, 3),
          select_calibration({1, 3}),
          of_key(CommandKind::kChangeKey, 3),
          of_key(CommandKind::kConfirmKey, 3)};
}

}  // namespace lasso::test
