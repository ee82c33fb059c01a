// Command packets: space packet (space_packet.hpp) with the PUS-C (ECSS-E-ST-70-41C) telecommand secondary header.
//
//   0  primary header
//   6  PUS version 2 (4 bits), acknowledgements asked for (4 bits: acceptance, start, progress, completion)
//   7  service, 8 subservice, 9 source (16)
//   11 application data
//   n-2 CRC-16
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/span.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

constexpr std::size_t kCommandHeaderBytes = 11;
constexpr std::uint8_t kAcknowledgeAcceptance = 1;
constexpr std::uint8_t kAcknowledgeStart = 2;
constexpr std::uint8_t kAcknowledgeCompletion = 8;

struct CommandHeader {
  std::uint16_t apid = kApid;
  std::uint16_t sequence_count = 0;  // modulo 2^14
  std::uint8_t acknowledge = kAcknowledgeAcceptance | kAcknowledgeCompletion;
  std::uint8_t service = 0;
  std::uint8_t subservice = 0;
  std::uint16_t source = 0;
};

// Begins a packet; finish_packet ends it.
void begin_command(const CommandHeader& header, ByteWriter& writer);

// Checks a whole packet for the component `apid`. `header` and `data` (the application data) are untouched when it is refused.
PacketFault parse_command(ConstBytes packet, CommandHeader& header, ConstBytes& data, std::uint16_t apid = kApid);

}  // namespace lasso
