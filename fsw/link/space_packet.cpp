#include "fsw/link/space_packet.hpp"

#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr std::size_t kLengthOffset = 4;
constexpr std::size_t kLargestBytes = kPrimaryHeaderBytes + 0x10000;
constexpr std::uint16_t kApidMask = 0x07FF;

PacketFault check_size(ConstBytes packet, std::size_t least) {
  if (packet.size() < least) return PacketFault::kTruncated;
  const std::size_t stated = packet_size(packet);
  if (stated > packet.size()) return PacketFault::kTruncated;
  return stated == packet.size() ? PacketFault::kNone : PacketFault::kBadLength;
}

PacketFault check_header(const PrimaryHeader& header, PacketType type, std::uint16_t apid) {
  if (header.version != 0) return PacketFault::kBadVersion;
  if (header.type != type) return PacketFault::kBadType;
  if (!header.secondary_header) return PacketFault::kNoSecondaryHeader;
  if (header.apid != apid) return PacketFault::kOtherApid;
  return header.sequence_flags == kUnsegmented ? PacketFault::kNone : PacketFault::kSegmented;
}

}  // namespace

const char* to_string(PacketFault fault) {
  switch (fault) {
    case PacketFault::kNone:
      return "none";
    case PacketFault::kTruncated:
      return "truncated";
    case PacketFault::kBadLength:
      return "bad_length";
    case PacketFault::kBadCrc:
      return "bad_crc";
    case PacketFault::kBadVersion:
      return "bad_version";
    case PacketFault::kBadType:
      return "bad_type";
    case PacketFault::kNoSecondaryHeader:
      return "no_secondary_header";
    case PacketFault::kOtherApid:
      return "other_apid";
    case PacketFault::kSegmented:
      return "segmented";
    case PacketFault::kBadPusVersion:
      return "bad_pus_version";
    case PacketFault::kUnknown:
      return "unknown";
    case PacketFault::kBadArgument:
      return "bad_argument";
    case PacketFault::kRepeated:
      return "repeated";
    case PacketFault::kNotAuthentic:
      return "not_authentic";
  }
  return "no fault";  // a value that no enumerator has
}

PrimaryHeader read_primary_header(ConstBytes packet) {
  ByteReader in(packet.first(kPrimaryHeaderBytes));
  const std::uint32_t identification = in.u16();
  const std::uint32_t sequence = in.u16();
  PrimaryHeader header;
  header.version = static_cast<std::uint8_t>(identification >> 13);
  header.type = static_cast<PacketType>(identification >> 12 & 1U);
  header.secondary_header = (identification >> 11 & 1U) != 0;
  header.apid = static_cast<std::uint16_t>(identification & kApidMask);
  header.sequence_flags = static_cast<std::uint8_t>(sequence >> 14);
  header.sequence_count = static_cast<std::uint16_t>(sequence & kSequenceCountMask);
  header.data_length = in.u16();
  return header;
}

void write_primary_header(const PrimaryHeader& header, ByteWriter& writer) {
  const std::uint32_t identification = static_cast<std::uint32_t>(header.version) << 13 | static_cast<std::uint32_t>(header.type) << 12 |
                                       (header.secondary_header ? 1U << 11 : 0U) | (header.apid & kApidMask);
  const std::uint32_t sequence = static_cast<std::uint32_t>(header.sequence_flags) << 14 | (header.sequence_count & kSequenceCountMask);
  writer.u16(static_cast<std::uint16_t>(identification));
  writer.u16(static_cast<std::uint16_t>(sequence));
  writer.u16(0);
}

std::size_t finish_packet(ByteWriter& writer, Bytes out) {
  const std::size_t size = writer.size() + kPacketTrailerBytes;
  if (!writer.ok() || size > out.size() || size > kLargestBytes) return 0;
  ByteWriter length(out.subspan(kLengthOffset, 2));
  length.u16(static_cast<std::uint16_t>(size - kPrimaryHeaderBytes - 1));
  writer.u16(crc16_ccitt(writer.written()));
  return size;
}

std::size_t packet_size(ConstBytes stream) {
  if (stream.size() < kPrimaryHeaderBytes) return 0;
  ByteReader in(stream.subspan(kLengthOffset, 2));
  return kPrimaryHeaderBytes + 1 + in.u16();
}

PacketFault check_packet(ConstBytes packet, PacketType type, std::size_t least, std::uint16_t apid) {
  const PacketFault fault = check_size(packet, least);
  if (fault != PacketFault::kNone) return fault;
  // The checksum over data and its own checksum is zero.
  if (crc16_ccitt(packet) != 0) return PacketFault::kBadCrc;
  return check_header(read_primary_header(packet), type, apid);
}

}  // namespace lasso
