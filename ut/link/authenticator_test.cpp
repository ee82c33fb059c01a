#include "fsw/link/authenticator.hpp"

#include "fsw/link/command_receiver.hpp"
#include "ut/link/keyed_sum.hpp"

namespace lasso {
namespace {

using test::KeyedSum;
using test::Stream;
using test::view;
using test::with_sum;

TEST(Authenticator, IsAskedForEachCommandThatIsWhole) {
  VERIFIES("LASSO-LNK-021~2");
  KeyedSum authenticator;
  CommandReceiver receiver;
  receiver.use_authenticator(authenticator);
  Command command;
  Stream damaged = with_sum(test::ping(1));
  damaged.back() = static_cast<std::uint8_t>(damaged.back() ^ 1U);
  EXPECT_EQ(receiver.accept(view(damaged), command), PacketFault::kBadCrc);
  EXPECT_EQ(authenticator.asked, 0) << "damage is not forgery";
  EXPECT_EQ(receiver.accept(view(with_sum(test::set_mode(5, 1))), command), PacketFault::kNone);
  EXPECT_EQ(command.mode.mode, 5);
  EXPECT_EQ(receiver.accept(view(with_sum(test::offer_start(StartCommand{}, 2))), command), PacketFault::kNone) << "the longest";
  EXPECT_EQ(receiver.accept(view(with_sum(test::ping(2))), command), PacketFault::kRepeated) << "counts hold as well";
  EXPECT_EQ(authenticator.asked, 3);
}

TEST(Authenticator, WhatHasNoRightTrailerIsRefusedBeforeItsArgumentsAreLookedAt) {
  VERIFIES("LASSO-LNK-021~2");
  KeyedSum authenticator;
  CommandReceiver receiver;
  receiver.use_authenticator(authenticator);
  Command command;
  command.header.source = 99;
  EXPECT_EQ(receiver.accept(view(test::ping(1)), command), PacketFault::kNotAuthentic) << "no room for a trailer";
  EXPECT_EQ(authenticator.asked, 0);
  EXPECT_EQ(receiver.accept(view(test::offer_start(StartCommand{}, 1)), command), PacketFault::kNotAuthentic);
  EXPECT_EQ(receiver.accept(view(test::set_mode(99, 1)), command), PacketFault::kNotAuthentic) << "not: bad argument";
  EXPECT_EQ(receiver.accept(view(with_sum(test::set_mode(99, 1))), command), PacketFault::kBadArgument);
  const Stream good = with_sum(test::set_hold(1, 1));
  for (std::size_t bit = 0; bit < (good.size() - 2) * 8; ++bit) {
    Stream forged = good;
    forged[bit / 8] = static_cast<std::uint8_t>(forged[bit / 8] ^ (1U << (bit % 8)));
    test::repair_crc(forged);
    const PacketFault fault = receiver.accept(view(forged), command);
    ASSERT_NE(fault, PacketFault::kNone) << bit;
    const bool of_count = (bit >= 16 && bit < 22) || bit / 8 == 3;
    ASSERT_TRUE(!of_count || fault == PacketFault::kNotAuthentic) << "the sequence count is covered, too: " << bit;
  }
  EXPECT_EQ(command.header.source, 99) << "untouched";
  EXPECT_EQ(receiver.accept(view(good), command), PacketFault::kNone) << "the sequence is untouched";
}

}  // namespace
}  // namespace lasso
