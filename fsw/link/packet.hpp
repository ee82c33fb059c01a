// Telemetry packets: CCSDS 133.0-B-2 space packet, PUS-C (ECSS-E-ST-70-41C) telemetry secondary header, CRC-16 trailer.
//
//   0  version 000, type 0, secondary header flag 1, APID (11 bits)
//   2  sequence flags 11, sequence count (14 bits)
//   4  data length: octets after the primary header, minus one
//   6  PUS version 2 (4 bits), spacecraft time reference status (4 bits)
//   7  service, 8 subservice, 9 message type counter (16), 11 destination (16)
//   13 CUC time (301.0-B-4), implicit P-field: 4 octets of seconds, 3 octets of 2^-24 s, since the mission's epoch
//   20 source data
//   n-2 CRC-16 over all octets before it
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"

namespace lasso {

constexpr std::uint16_t kApid = 0x3D1;
constexpr std::uint8_t kPusVersion = 2;
constexpr std::size_t kPrimaryHeaderBytes = 6;
constexpr std::size_t kPacketHeaderBytes = 20;
constexpr std::size_t kPacketTrailerBytes = 2;
constexpr std::uint16_t kSequenceCountMask = 0x3FFF;
constexpr std::uint8_t kServiceHousekeeping = 3;
constexpr std::uint8_t kSubserviceHousekeepingReport = 25;

struct PacketHeader {
  std::uint16_t apid = kApid;
  std::uint16_t sequence_count = 0;  // modulo 2^14
  std::uint8_t time_status = 0;
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

// Begins a packet in `out` with the data length still open; finish_packet sets it and appends the CRC. The buffer of `writer` must
// be `out`. finish_packet returns the packet's size, 0 when something did not fit.
void begin_packet(const PacketHeader& header, ByteWriter& writer);
std::size_t finish_packet(ByteWriter& writer, Bytes out);

// The size that the primary header at the start of `stream` states; 0 when the header itself is not whole.
std::size_t packet_size(ConstBytes stream);

// Checks a whole packet: length (kTruncated, kBadLength), CRC (kBadCrc), versions and flags (kBadVersion). `data` is the source data.
Status parse_packet(ConstBytes packet, PacketHeader& header, ConstBytes& data);

}  // namespace lasso
