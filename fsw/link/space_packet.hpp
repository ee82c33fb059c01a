// CCSDS 133.0-B-2 space packets, as commands and telemetry have them in common.
//
//   0  version 000, type (0 telemetry, 1 command), secondary header flag, APID (11 bits)
//   2  sequence flags (2 bits), sequence count (14 bits)
//   4  data length: octets after the primary header, minus one
//   6  secondary header, data
//   n-2 CRC-16 over all octets before it
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/identity.hpp"
#include "fsw/core/span.hpp"

namespace lasso {

constexpr std::uint8_t kPusVersion = 2;
constexpr std::uint8_t kUnsegmented = 3;
constexpr std::size_t kPrimaryHeaderBytes = 6;
constexpr std::size_t kPacketTrailerBytes = 2;
constexpr std::uint16_t kSequenceCountMask = 0x3FFF;

enum class PacketType : std::uint8_t { kTelemetry = 0, kCommand = 1 };

struct PrimaryHeader {
  std::uint8_t version = 0;
  PacketType type = PacketType::kTelemetry;
  bool secondary_header = true;
  std::uint16_t apid = kApid;
  std::uint8_t sequence_flags = kUnsegmented;
  std::uint16_t sequence_count = 0;  // modulo 2^14
  std::uint16_t data_length = 0;
};

// Why a packet is refused. The numbers are on the wire.
enum class [[nodiscard]] PacketFault : std::uint8_t{
    kNone = 0,
    kTruncated = 1,          // fewer bytes than its headers need, or than its length field says
    kBadLength = 2,          // more bytes than its length field says, or not as many as its rows need
    kBadCrc = 3,             // the checksum does not match
    kBadVersion = 4,         // the packet version number is not 0
    kBadType = 5,            // a command where telemetry is expected, or the reverse
    kNoSecondaryHeader = 6,  // the flag of the secondary header is 0
    kOtherApid = 7,          // for somebody else
    kSegmented = 8,          // the sequence flags are not 11
    kBadPusVersion = 9,      // the secondary header is not of PUS-C
    kUnknown = 10,           // nothing has this service, subservice and number
    kBadArgument = 11,       // a value is outside of its item's range
    kRepeated = 12,          // the sequence count is not after the one of the last accepted command
    kNotAuthentic = 13,      // its trailer does not show who sent it
};
const char* to_string(PacketFault fault);  // never null

// The first kPrimaryHeaderBytes bytes, which have to be there.
PrimaryHeader read_primary_header(ConstBytes packet);
// With the data length still open: finish_packet sets it.
void write_primary_header(const PrimaryHeader& header, ByteWriter& writer);

// Sets the data length and appends the CRC. The buffer of `writer` must be `out`. Returns the packet's size, 0 when something did not fit.
std::size_t finish_packet(ByteWriter& writer, Bytes out);

// The size that the primary header at the start of `stream` states; 0 when the header itself is not whole.
std::size_t packet_size(ConstBytes stream);

// Checks all that commands and telemetry have in common, in the order of PacketFault: at least `least` bytes, as many as it says, CRC, and
// each field of the primary header; its application process has to be `apid`.
PacketFault check_packet(ConstBytes packet, PacketType type, std::size_t least, std::uint16_t apid);

}  // namespace lasso
