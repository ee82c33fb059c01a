#include "fsw/link/named_pose_report.hpp"

#include "fsw/link/named_pose_rows.hpp"

namespace lasso {
namespace {

constexpr auto kNamedPose = codec_of(named_pose_rows::kRows);

}  // namespace

std::size_t encode_named_pose(const NamedPoseTelemetry& pose, const PacketHeader& header, Bytes out) {
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kNamedPoseStructureId);
  kNamedPose.write(pose, writer);
  return finish_packet(writer, out);
}

}  // namespace lasso
