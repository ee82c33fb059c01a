#include "fsw/link/named_pose_report.hpp"

#include "fsw/link/named_pose_rows.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::Stream;

TEST(NamedPoseReport, LiesOnTheWireAsItsRowsSay) {
  VERIFIES("LASSO-LNK-050~1 LASSO-LNK-002~1");
  NamedPoseTelemetry pose;
  pose.scan_id = 0x01020304;
  pose.t_measurement_us = 0x1122334455667788;
  pose.pair = 2;
  pose.pairs = 3;
  pose.valid = 1;
  pose.p_in_of_m[2] = 7.5;
  pose.started = 1;
  pose.filter_v_mps[1] = -0.25;
  for (std::size_t i = 0; i < kPoseCovarianceTerms; ++i) pose.covariance[i] = -static_cast<float>(i);
  for (std::size_t i = 0; i < kFilterCovarianceTerms; ++i) pose.filter_covariance[i] = static_cast<float>(i) + 0.5F;
  Stream packet(kMaxNamedPoseBytes);
  packet.resize(encode_named_pose(pose, PacketHeader{}, Bytes(packet.data(), packet.size())));
  const Stream data(packet.begin() + kPacketHeaderBytes, packet.end() - kPacketTrailerBytes);
  const Stream head{0, 7, 1, 2, 3, 4, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88, 2, 3, 1};
  ASSERT_EQ(data.size(), head.size() + 7 * 8 + 4 * kPoseCovarianceTerms + 1 + 8 + 13 * 8 + 4 * kFilterCovarianceTerms);
  EXPECT_EQ(Stream(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(head.size())), head);
  NamedPoseTelemetry read;
  ByteReader in(ConstBytes(data.data(), data.size()));
  in.u16();
  codec_of(named_pose_rows::kRows).read(in, read);
  EXPECT_EQ(read.q_in_of[3], 1);
  EXPECT_EQ(read.p_in_of_m[2], 7.5);
  EXPECT_EQ(read.filter_v_mps[1], -0.25);
  for (std::size_t i = 0; i < kPoseCovarianceTerms; ++i) EXPECT_EQ(read.covariance[i], pose.covariance[i]) << i;
  for (std::size_t i = 0; i < kFilterCovarianceTerms; ++i) EXPECT_EQ(read.filter_covariance[i], pose.filter_covariance[i]) << i;
  EXPECT_EQ(encode_named_pose(pose, PacketHeader{}, Bytes(packet.data(), packet.size() - 1)), 0U);
}

}  // namespace
}  // namespace lasso
