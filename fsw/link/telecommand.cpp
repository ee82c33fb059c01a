#include "fsw/link/telecommand.hpp"

namespace lasso {

void begin_command(const CommandHeader& header, ByteWriter& writer) {
  PrimaryHeader primary;
  primary.type = PacketType::kCommand;
  primary.apid = header.apid;
  primary.sequence_count = header.sequence_count;
  write_primary_header(primary, writer);
  writer.u8(static_cast<std::uint8_t>(kPusVersion << 4 | (header.acknowledge & 0x0F)));
  writer.u8(header.service);
  writer.u8(header.subservice);
  writer.u16(header.source);
}

PacketFault parse_command(ConstBytes packet, CommandHeader& header, ConstBytes& data, std::uint16_t apid) {
  const PacketFault fault = check_packet(packet, PacketType::kCommand, kCommandHeaderBytes + kPacketTrailerBytes, apid);
  if (fault != PacketFault::kNone) return fault;
  ByteReader in(packet.subspan(kPrimaryHeaderBytes, kCommandHeaderBytes - kPrimaryHeaderBytes));
  const std::uint8_t version = in.u8();
  if (version >> 4 != kPusVersion) return PacketFault::kBadPusVersion;
  const PrimaryHeader primary = read_primary_header(packet);
  header.apid = primary.apid;
  header.sequence_count = primary.sequence_count;
  header.acknowledge = version & 0x0F;
  header.service = in.u8();
  header.subservice = in.u8();
  header.source = in.u16();
  data = packet.subspan(kCommandHeaderBytes, packet.size() - kCommandHeaderBytes - kPacketTrailerBytes);
  return PacketFault::kNone;
}

}  // namespace lasso
