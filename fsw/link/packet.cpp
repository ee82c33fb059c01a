#include "fsw/link/packet.hpp"

#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr std::int64_t kUsPerSecond = 1000000;
constexpr std::int64_t kFractionsPerSecond = std::int64_t{1} << 24;
constexpr std::uint16_t kTelemetryIdentification = 0x0800;  // version 0, telemetry, secondary header present
constexpr std::uint16_t kApidMask = 0x07FF;
constexpr std::uint16_t kUnsegmented = 0xC000;
constexpr std::size_t kLengthOffset = 4;

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

Status check_frame(ConstBytes packet) {
  if (packet.size() < kPacketHeaderBytes + kPacketTrailerBytes) return Status::kTruncated;
  if (packet_size(packet) > packet.size()) return Status::kTruncated;
  if (packet_size(packet) != packet.size()) return Status::kBadLength;
  // The check sum over data and its own check sum is zero.
  return crc16_ccitt(packet) == 0 ? Status::kOk : Status::kBadCrc;
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
  writer.u16(static_cast<std::uint16_t>(kTelemetryIdentification | (header.apid & kApidMask)));
  writer.u16(static_cast<std::uint16_t>(kUnsegmented | (header.sequence_count & kSequenceCountMask)));
  writer.u16(0);
  writer.u8(static_cast<std::uint8_t>(kPusVersion << 4 | (header.time_status & 0x0F)));
  writer.u8(header.service);
  writer.u8(header.subservice);
  writer.u16(header.message_count);
  writer.u16(header.destination);
  write_time(header.t_us, writer);
}

std::size_t finish_packet(ByteWriter& writer, Bytes out) {
  const std::size_t size = writer.size() + kPacketTrailerBytes;
  if (!writer.ok() || size > out.size() || size > kPrimaryHeaderBytes + 0x10000) return 0;
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

Status parse_packet(ConstBytes packet, PacketHeader& header, ConstBytes& data) {
  const Status frame = check_frame(packet);
  if (frame != Status::kOk) return frame;
  ByteReader in(packet);
  const std::uint16_t identification = in.u16();
  const std::uint16_t sequence = in.u16();
  in.u16();
  const std::uint8_t version = in.u8();
  if ((identification & ~kApidMask) != kTelemetryIdentification) return Status::kBadVersion;
  if ((sequence & ~kSequenceCountMask) != kUnsegmented || version >> 4 != kPusVersion) return Status::kBadVersion;
  header.apid = identification & kApidMask;
  header.sequence_count = sequence & kSequenceCountMask;
  header.time_status = version & 0x0F;
  read_secondary_header(in, header);
  data = packet.subspan(kPacketHeaderBytes, packet.size() - kPacketHeaderBytes - kPacketTrailerBytes);
  return Status::kOk;
}

}  // namespace lasso
