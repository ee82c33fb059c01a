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

inline Stream ping(std::uint16_t count = 0) {
  CommandHeader header;
  header.sequence_count = count;
  header.service = kServiceTest;
  header.subservice = kSubservicePing;
  Stream packet(kMaxCommandBytes);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin_command(header, writer);
  return finished(writer, packet);
}

template <class Arguments, std::size_t kRows>
Stream function_packet(CommandKind kind, const TypedRow<Arguments> (&rows)[kRows], const Arguments& arguments, std::uint16_t count = 0) {
  CommandHeader header;
  header.sequence_count = count;
  header.service = kServiceFunction;
  header.subservice = kSubservicePerform;
  Stream packet(kMaxCommandBytes);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin_command(header, writer);
  writer.u16(static_cast<std::uint16_t>(kind));
  codec_of(rows).write(arguments, writer);
  return finished(writer, packet);
}

inline Stream set_mode(std::uint8_t mode, std::uint16_t count = 0) {
  return function_packet(CommandKind::kMode, command_rows::kMode, ModeCommand{mode}, count);
}
inline Stream set_hold(std::uint8_t held, std::uint16_t count = 0) {
  return function_packet(CommandKind::kHold, command_rows::kHold, HoldCommand{held}, count);
}
inline Stream offer_start(const StartCommand& start, std::uint16_t count = 0) {
  return function_packet(CommandKind::kStart, command_rows::kStart, start, count);
}

}  // namespace lasso::test
