#include "fsw/link/pose_telemetry.hpp"

#include "fsw/link/pose_rows.hpp"

namespace lasso {
namespace {

constexpr auto kCodec = codec_of(pose_rows::kRows);

bool is_pose_report(const PacketHeader& header) {
  return header.service == kServiceHousekeeping && header.subservice == kSubserviceHousekeepingReport;
}

}  // namespace

std::size_t encode_pose(const PoseTelemetry& pose, PacketHeader header, Bytes out) {
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kPoseStructureId);
  kCodec.write(pose, writer);
  return finish_packet(writer, out);
}

PacketFault decode_pose(ConstBytes packet, PacketHeader& header, PoseTelemetry& pose, std::uint16_t apid) {
  PacketHeader parsed;
  ConstBytes data;
  const PacketFault fault = parse_packet(packet, parsed, data, apid);
  if (fault != PacketFault::kNone) return fault;
  ByteReader in(data);
  if (!is_pose_report(parsed) || in.u16() != kPoseStructureId) return PacketFault::kUnknown;
  if (in.remaining() != kCodec.bytes) return PacketFault::kBadLength;
  kCodec.read(in, pose);
  header = parsed;
  return PacketFault::kNone;
}

}  // namespace lasso
