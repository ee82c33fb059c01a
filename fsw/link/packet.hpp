// Telemetry packets: space packet (space_packet.hpp) with the PUS-C (ECSS-E-ST-70-41C) telemetry secondary header.
//
//   0  primary header
//   6  PUS version 2 (4 bits), spacecraft time reference status (4 bits)
//   7  service, 8 subservice, 9 message type counter (16), 11 destination (16)
//   13 CUC time (301.0-B-4), implicit P-field: 4 octets of seconds, 3 octets of 2^-24 s, since the mission's epoch
//   20 source data
//   n-2 CRC-16
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

constexpr std::size_t kPacketHeaderBytes = 20;
constexpr std::size_t kPacketNumberBytes = 2;  // of the structure, first in the source data
constexpr std::uint8_t kServiceHousekeeping = 3;
constexpr std::uint8_t kSubserviceHousekeepingReport = 25;

// Quality of the time reference.
constexpr std::uint8_t kTimeStatusFree = 0;        // the component's own clock
constexpr std::uint8_t kTimeStatusCorrelated = 1;  // spacecraft time, by command

struct PacketHeader {
  std::uint16_t apid = kApid;
  std::uint16_t sequence_count = 0;  // modulo 2^14
  std::uint8_t time_status = kTimeStatusFree;
  std::uint8_t service = 0;
  std::uint8_t subservice = 0;
  std::uint16_t message_count = 0;  // modulo 2^16, per service and subservice
  std::uint16_t destination = 0;
  TimeUs t_us = 0;  // carried modulo 2^32 s
};

struct CucTime {
  std::uint32_t seconds = 0;
  std::uint32_t fraction = 0;  // 2^-24 s, 24 bits
};
CucTime to_cuc(TimeUs t_us);  // nearest 2^-24 s; seconds modulo 2^32
TimeUs from_cuc(CucTime t);   // nearest microsecond: from_cuc(to_cuc(t)) == t for 0 <= t < 2^32 s

// Begins a packet; finish_packet ends it.
void begin_packet(const PacketHeader& header, ByteWriter& writer);

// Checks a whole packet of the component `apid`. `header` and `data` (the source data) are untouched when it is refused.
PacketFault parse_packet(ConstBytes packet, PacketHeader& header, ConstBytes& data, std::uint16_t apid = kApid);

}  // namespace lasso
