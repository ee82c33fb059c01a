// Makes of any bytes a space packet that a reader gets past the envelope of.
#pragma once

#include "fsw/core/crc.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso::fuzz {

// Writes the packet's own length and checksum into it. A packet that is too short for both stays as it is.
inline void repair(Bytes packet) {
  if (packet.size() < kPrimaryHeaderBytes + kPacketTrailerBytes) return;
  const std::size_t length = packet.size() - kPrimaryHeaderBytes - 1;
  packet[4] = static_cast<std::uint8_t>(length >> 8);
  packet[5] = static_cast<std::uint8_t>(length);
  const std::size_t end = packet.size() - kPacketTrailerBytes;
  const std::uint16_t crc = crc16_ccitt(packet.first(end));
  packet[end] = static_cast<std::uint8_t>(crc >> 8);
  packet[end + 1] = static_cast<std::uint8_t>(crc);
}

}  // namespace lasso::fuzz
