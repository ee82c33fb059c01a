#include "fsw/link/frame_room.hpp"

#include "ut/link/command_packets.hpp"

namespace lasso {
namespace {

// How many packets of a kind a frame takes.
std::uint32_t taken(FrameRoom& room, const test::Stream& packet, PacketFault fault, bool from_operator) {
  std::uint32_t count = 0;
  for (; count < 1000 && room.takes(test::view(packet)); ++count) static_cast<void>(room.spend(fault, from_operator));
  return count;
}

TEST(FrameRoom, WhatMakesSafeHasRoomBehindAllOtherCommands) {
  VERIFIES("LASSO-LNK-040~2");
  const test::Stream ping = test::ping(), safe = test::set_mode(kSafeMode), laser = test::plain_packet(CommandKind::kInhibitLaser);
  FrameRoom room;
  EXPECT_EQ(taken(room, ping, PacketFault::kNone, true), 8u);
  EXPECT_FALSE(room.takes(test::view(test::set_mode(1)))) << "another mode";
  EXPECT_FALSE(room.takes(test::view(test::plain_packet(CommandKind::kEnableLaser))));
  EXPECT_FALSE(room.takes(test::view(test::Stream{0x1B})));
  EXPECT_TRUE(room.takes(test::view(laser)));
  EXPECT_FALSE(room.takes(test::view(test::for_apid(laser, 0x2A5)))) << "another component's";
  EXPECT_TRUE(room.takes(test::view(test::for_apid(laser, 0x2A5)), 0x2A5));
  EXPECT_EQ(taken(room, safe, PacketFault::kNone, true), 2u);
  EXPECT_FALSE(room.takes(test::view(laser)));
  room.renew();
  EXPECT_EQ(taken(room, safe, PacketFault::kNone, true), 10u);
}

TEST(FrameRoom, StrangersTakeNoCommandsRoomAndAreHardlyAnswered) {
  VERIFIES("LASSO-LNK-040~2 LASSO-LNK-013~2");
  const test::Stream ping = test::ping();
  FrameRoom room;
  std::uint32_t answered = 0, recounted = 0;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(room.takes(test::view(ping)));
    answered += room.spend(PacketFault::kNotAuthentic, false) ? 1U : 0U;
    recounted += room.spend(PacketFault::kRepeated, false) ? 1U : 0U;
  }
  EXPECT_EQ(answered, kMaxRefusalsPerFrame);
  EXPECT_EQ(recounted, kMaxRefusalsPerFrame) << "what is only counted wrong is answered beside a flood of the rest";
  EXPECT_EQ(taken(room, ping, PacketFault::kRepeated, true), 8u) << "the operator's, who is answered whatever is wrong";
  room.renew();
  EXPECT_EQ(taken(room, ping, PacketFault::kTruncated, false), kMaxStrangersPerFrame) << "a frame's work is bounded";
}

}  // namespace
}  // namespace lasso
