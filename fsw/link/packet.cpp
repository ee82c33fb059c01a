#include "fsw/link/packet.hpp"

namespace lasso {
namespace {

constexpr std::int64_t kUsPerSecond = 1000000;
constexpr std::int64_t kFractionsPerSecond = std::int64_t{1} << 24;

void write_time(TimeUs t_us, ByteWriter& out) {
  const CucTime t = to_cuc(t_us);
  out.u32(t.seconds);
  out.u8(static_cast<std::uint8_t>(t.fraction >> 16));
  out.u16(static_cast<std::uint16_t>(t.fraction & 0xFFFF));
}

TimeUs read_time(ByteReader& in) {
  CucTime t;
  t.seconds = in.u32();
  t.fraction = static_cast<std::uint32_t>(in.u8()) << 16;
  t.fraction |= in.u16();
  return from_cuc(t);
}

void read_secondary_header(ByteReader& in, PacketHeader& header) {
  header.service = in.u8();
  header.subservice = in.u8();
  header.message_count = in.u16();
  header.destination = in.u16();
  header.t_us = read_time(in);
}

}  // namespace

CucTime to_cuc(TimeUs t_us) {
  std::int64_t seconds = t_us / kUsPerSecond;
  std::int64_t us = t_us % kUsPerSecond;
  if (us < 0) {
    us += kUsPerSecond;
    seconds -= 1;
  }
  const std::int64_t fraction = (us * kFractionsPerSecond + kUsPerSecond / 2) / kUsPerSecond;
  return {static_cast<std::uint32_t>(seconds & 0xFFFFFFFF), static_cast<std::uint32_t>(fraction)};
}

TimeUs from_cuc(CucTime t) {
  const std::int64_t us = (static_cast<std::int64_t>(t.fraction) * kUsPerSecond + kFractionsPerSecond / 2) / kFractionsPerSecond;
  return static_cast<std::int64_t>(t.seconds) * kUsPerSecond + us;
}

void begin_packet(const PacketHeader& header, ByteWriter& writer) {
  PrimaryHeader primary;
  primary.apid = header.apid;
  primary.sequence_count = header.sequence_count;
  write_primary_header(primary, writer);
  writer.u8(static_cast<std::uint8_t>(kPusVersion << 4 | (header.time_status & 0x0F)));
  writer.u8(header.service);
  writer.u8(header.subservice);
  writer.u16(header.message_count);
  writer.u16(header.destination);
  write_time(header.t_us, writer);
}

PacketFault parse_packet(ConstBytes packet, PacketHeader& header, ConstBytes& data, std::uint16_t apid) {
  const PacketFault fault = check_packet(packet, PacketType::kTelemetry, kPacketHeaderBytes + kPacketTrailerBytes, apid);
  if (fault != PacketFault::kNone) return fault;
  ByteReader in(packet.subspan(kPrimaryHeaderBytes, kPacketHeaderBytes - kPrimaryHeaderBytes));
  const std::uint8_t version = in.u8();
  if (version >> 4 != kPusVersion) return PacketFault::kBadPusVersion;
  const PrimaryHeader primary = read_primary_header(packet);
  header.apid = primary.apid;
  header.sequence_count = primary.sequence_count;
  header.time_status = version & 0x0F;
  read_secondary_header(in, header);
  data = packet.subspan(kPacketHeaderBytes, packet.size() - kPacketHeaderBytes - kPacketTrailerBytes);
  return PacketFault::kNone;
}

}  // namespace lasso
