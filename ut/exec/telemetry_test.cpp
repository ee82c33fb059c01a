// When structures are sent, how much that is, and what time they state; by the link alone.
#include <algorithm>

#include "ut/exec/component_operator.hpp"
#include "ut/link/pose_packet.hpp"

namespace lasso {
namespace {

using test::Link;
using test::Packet;
using test::told;

std::uint8_t number(ServiceRefusal refusal) { return static_cast<std::uint8_t>(refusal); }

std::size_t poses(const std::vector<Packet>& packets) {
  return static_cast<std::size_t>(std::count_if(
      packets.begin(), packets.end(), [](const Packet& packet) { return packet.is(3, 25) && packet.data[1] == kPoseStructureId; }));
}

TEST(Telemetry, StructuresAreDisabledEnabledGivenAPeriodAndAskedForOnce) {
  VERIFIES("LASSO-LNK-014~1");
  Link link;
  const auto frames_with_poses = [&](int frames) {
    std::string sent;
    for (int frame = 0; frame < frames; ++frame) sent += poses(link.run_frame()) == 1 ? '1' : '0';
    return sent;
  };
  EXPECT_EQ(frames_with_poses(6), "001111");
  link.send(test::set_period(kPoseStructureId, 5, 0));
  EXPECT_EQ(frames_with_poses(12), "000010000100");
  link.send(test::of_structure(CommandKind::kDisableStructure, kPoseStructureId, 1));
  EXPECT_EQ(frames_with_poses(6), "000000");
  link.send(test::of_structure(CommandKind::kReportStructure, kPoseStructureId, 2));
  EXPECT_EQ(frames_with_poses(3), "100");
  link.send(test::set_period(kPoseStructureId, 1, 3));
  link.send(test::of_structure(CommandKind::kEnableStructure, kPoseStructureId, 4));
  EXPECT_EQ(frames_with_poses(3), "111");
  link.send(test::of_structure(CommandKind::kReportStructure, 0, 5));
  link.answers();
  link.send(test::set_period(0, 5, 6));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNoSuchStructure));
}

// Everything at its presets, an event and an answer in each frame.
TEST(Telemetry, TheWholeStreamFits64KilobitsASecond) {
  VERIFIES("LASSO-LNK-031~1");
  Link link;
  std::size_t bytes = 0, fewer = 0;
  for (std::uint16_t frame = 0; frame < 50; ++frame) {
    link.send(test::set_mode(99, frame));
    for (const Packet& packet : link.run_frame()) bytes += packet.data.size() + 22;
  }
  EXPECT_GT(bytes, 48 * test::pose_packet_bytes());
  EXPECT_LE(bytes * 8, 64000U * 10) << "50 frames of 0.2 s";
  link.send(test::set_period(kPoseStructureId, 5, 100));
  for (int frame = 0; frame < 50; ++frame) {
    for (const Packet& packet : link.run_frame()) fewer += packet.data.size() + 22;
  }
  EXPECT_LT(fewer * 4, bytes) << "the rate is selectable";
}

TEST(Telemetry, HeadersStateSpacecraftTimeOnceItIsCorrelated) {
  VERIFIES("LASSO-LNK-037~2 LASSO-HLT-006~2");
  Link link;
  link.run_frame();
  link.send(test::correlate_time(0, 86400000000, 0));
  link.answers();
  const std::vector<Packet> packets = link.run_frame();
  ASSERT_TRUE(told(packets, EventId::kTimeCorrelated));
  for (const Packet& packet : packets) {
    EXPECT_EQ(packet.header.t_us, 86400000000 + 200000);
    EXPECT_EQ(packet.header.time_status, kTimeStatusCorrelated);
  }
  const TimeUs jumped_us = link.component().next_slot_us() + 60'000'000;
  link.component().run_slot(jumped_us);
  const std::vector<Packet> after = link.answers();
  ASSERT_FALSE(after.empty());
  for (const Packet& packet : after) {
    EXPECT_EQ(packet.header.t_us, jumped_us) << "a clock that jumped is correlated with nothing";
    EXPECT_EQ(packet.header.time_status, 0);
  }
}

}  // namespace
}  // namespace lasso
