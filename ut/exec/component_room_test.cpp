// What a frame takes of commands, and what waits for a later one.
#include <algorithm>

#include "ut/exec/component_operator.hpp"

namespace lasso {
namespace {

using test::Link;
using test::Packet;
using test::Stream;
using test::view;

TEST(ComponentRoom, AFloodIsAnsweredByTheFrame) {
  VERIFIES("LASSO-LNK-011~2 LASSO-LNK-022~2");
  Link link;
  Stream flood;
  for (std::uint16_t i = 0; i < 20; ++i) test::append(flood, test::ping(i));
  std::size_t taken = 0;
  for (int frame = 0; frame < 3; ++frame) {
    taken += link.send(Stream(flood.begin() + static_cast<std::ptrdiff_t>(taken), flood.end()));
    const std::size_t packets = kMaxCommandsPerFrame * static_cast<std::size_t>(frame + 1) + 1;  // one waits
    EXPECT_EQ(taken, std::min<std::size_t>(flood.size(), 13 * packets));
    EXPECT_EQ(link.component().receive_packet(view(test::ping(100)), 0), frame == 2);
    link.run_frame();
  }
}

TEST(ComponentRoom, WhatMakesSafeDoesNotWaitBehindAFramesCommands) {
  VERIFIES("LASSO-LNK-040~2 LASSO-LNK-022~2");
  for (const bool datagrams : {false, true}) {
    Link link;
    const auto send = [&](const Stream& packet) {
      return datagrams ? link.component().receive_packet(view(packet), 0) : link.send(packet) == packet.size();
    };
    for (std::uint16_t i = 0; i < kMaxCommandsPerFrame; ++i) EXPECT_TRUE(send(test::ping(i)));
    EXPECT_TRUE(send(test::set_mode(kSafeMode, 20)));
    EXPECT_EQ(link.answers().size(), 3 * kMaxCommandsPerFrame + 2) << "it is answered at once";
    link.run_frame();
    EXPECT_EQ(link.pose_of(link.run_frame()).mode, kSafeMode);
  }
}

TEST(ComponentRoom, ACommandBehindAFalseStartWaitsForASilentFrame) {
  VERIFIES("LASSO-LNK-028~1");
  Link link;
  Stream stream = test::offer_start(StartCommand{});
  stream.resize(60);
  for (std::uint16_t i = 0; i < kMaxCommandsPerFrame + 1; ++i) test::append(stream, test::ping(i));
  EXPECT_EQ(link.send(stream), stream.size());
  EXPECT_TRUE(link.answers().empty());
  EXPECT_TRUE(link.run_link_frame().empty()) << "bytes came in this frame";
  std::size_t pongs = 0;
  for (int frame = 0; frame < 2; ++frame) {
    for (const Packet& packet : link.run_link_frame()) pongs += packet.is(17, 2) ? 1u : 0u;
    EXPECT_EQ(pongs, kMaxCommandsPerFrame + static_cast<std::size_t>(frame));
  }
  link.send({0x1B});
  EXPECT_EQ(link.send({}), 0u);
  link.run_link_frame();
  const std::vector<Packet> told = link.run_link_frame();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].data[14], 61) << "the false start is skipped, and what never went on";
}

}  // namespace
}  // namespace lasso
