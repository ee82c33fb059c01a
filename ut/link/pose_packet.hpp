// The packet `pose` as tests of other rooms need it.
#pragma once

#include "fsw/link/pose_telemetry.hpp"

namespace lasso::test {

// Its length is always the same; ut/link/link_report_test.cpp states it.
inline std::size_t pose_packet_bytes() {
  std::uint8_t packet[kMaxPosePacketBytes];
  return encode_pose(PoseTelemetry{}, PacketHeader{}, Bytes(packet));
}

}  // namespace lasso::test
