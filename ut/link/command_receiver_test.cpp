#include "fsw/link/command_receiver.hpp"

#include "ut/link/keyed_sum.hpp"

namespace lasso {
namespace {

using test::Stream;
using test::view;

PacketFault accept(CommandReceiver& receiver, const Stream& packet) {
  Command command;
  return receiver.accept(view(packet), command);
}

TEST(CommandReceiver, FindsAcceptsAndCounts) {
  VERIFIES("LASSO-LNK-019~2");
  CommandReceiver receiver;
  Stream stream = {1, 2, 3};
  test::append(stream, test::set_mode(5, 1));
  EXPECT_EQ(receiver.take(view(stream)), stream.size());
  Command command;
  ASSERT_EQ(receiver.accept(receiver.packet(), command), PacketFault::kNone);
  EXPECT_EQ(command.mode.mode, 5);
  EXPECT_EQ(receiver.accepted(), 1u);
  EXPECT_EQ(receiver.refused(), 0u);
  EXPECT_EQ(receiver.skipped(), 3u);
  EXPECT_EQ(accept(receiver, test::set_mode(99, 2)), PacketFault::kBadArgument);
  EXPECT_EQ(receiver.accepted(), 1u);
  EXPECT_EQ(receiver.refused(), 1u);
  EXPECT_EQ(receiver.last_fault(), PacketFault::kBadArgument);
}

TEST(CommandReceiver, EveryTruncationAndEveryBitErrorIsRefusedAndCounted) {
  VERIFIES("LASSO-LNK-019~2 LASSO-SYS-011~2");
  for (const Stream& good : test::every_command()) {
    CommandReceiver receiver;
    Command command;
    command.header.source = 99;
    std::uint32_t refused = 0;
    for (std::size_t n = 0; n < good.size(); ++n) {
      ASSERT_NE(receiver.accept(ConstBytes(good.data(), n), command), PacketFault::kNone);
      ASSERT_EQ(receiver.refused(), ++refused);
    }
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
      Stream damaged = good;
      damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
      ASSERT_NE(receiver.accept(view(damaged), command), PacketFault::kNone) << bit;
      ASSERT_EQ(receiver.refused(), ++refused);
    }
    EXPECT_EQ(receiver.accepted(), 0u);
    EXPECT_EQ(command.header.source, 99) << "untouched";
    EXPECT_EQ(receiver.accept(view(good), command), PacketFault::kNone) << "the sequence is untouched";
  }
}

// By bytes that belong to no packet, and by no refusal: nobody knows that it was one.
TEST(CommandReceiver, OfAStreamWhatIsCutOrDamagedIsSkippedAndCounted) {
  VERIFIES("LASSO-LNK-019~2");
  for (const Stream& good : test::every_command()) {
    CommandReceiver receiver;
    std::uint32_t skipped = 0;
    const auto is_skipped = [&](const Stream& bytes) {
      receiver.take(view(bytes));
      while (receiver.packet().empty() && receiver.give_up()) {
      }
      skipped += static_cast<std::uint32_t>(bytes.size());
      return receiver.packet().empty() && receiver.skipped() == skipped;
    };
    for (std::size_t n = 0; n < good.size(); ++n)
      ASSERT_TRUE(is_skipped({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n)})) << n;
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
      Stream damaged = good;
      damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
      ASSERT_TRUE(is_skipped(damaged)) << bit;
    }
    receiver.take(view(good));
    EXPECT_EQ(Stream(receiver.packet().begin(), receiver.packet().end()), good) << "it is found behind all that";
  }
}

TEST(CommandReceiver, ACommandIsAcceptedOnce) {
  VERIFIES("LASSO-LNK-018~2");
  CommandReceiver receiver;
  EXPECT_EQ(accept(receiver, test::ping(0)), PacketFault::kNone) << "the first may have any count";
  EXPECT_EQ(accept(receiver, test::ping(0)), PacketFault::kRepeated);
  EXPECT_EQ(accept(receiver, test::ping(5)), PacketFault::kNone);
  EXPECT_EQ(accept(receiver, test::ping(4)), PacketFault::kRepeated);
  EXPECT_EQ(accept(receiver, test::ping(5)), PacketFault::kRepeated);
  EXPECT_EQ(accept(receiver, test::ping(5 + 8192)), PacketFault::kRepeated) << "half of all counts ahead is behind";
  EXPECT_EQ(accept(receiver, test::ping(5 + 8191)), PacketFault::kNone);
  EXPECT_EQ(accept(receiver, test::ping(16383)), PacketFault::kNone);
  EXPECT_EQ(accept(receiver, test::ping(0)), PacketFault::kNone) << "counts wrap";
  EXPECT_EQ(receiver.accepted(), 5u);
  EXPECT_EQ(receiver.refused(), 4u);
}

TEST(CommandReceiver, ARefusedCommandDoesNotMoveTheWindow) {
  VERIFIES("LASSO-LNK-018~2");
  CommandReceiver receiver;
  EXPECT_EQ(accept(receiver, test::ping(1)), PacketFault::kNone);
  EXPECT_EQ(accept(receiver, test::set_mode(99, 100)), PacketFault::kBadArgument);
  EXPECT_EQ(accept(receiver, test::ping(2)), PacketFault::kNone);
}

TEST(CommandReceiver, SaysWhetherAPacketComesFromWhoMayCommand) {
  VERIFIES("LASSO-LNK-040~2");
  CommandReceiver receiver;
  Command command;
  EXPECT_FALSE(receiver.from_operator());
  const auto from_operator = [&](const Stream& packet) {
    static_cast<void>(receiver.accept(view(packet), command));
    return receiver.from_operator();
  };
  EXPECT_TRUE(from_operator(test::ping(1)));
  EXPECT_FALSE(from_operator(test::ping(1))) << "repeated";
  EXPECT_FALSE(from_operator(test::set_mode(99, 2)));
  test::KeyedSum authenticator;
  receiver.use_authenticator(authenticator);
  EXPECT_FALSE(from_operator(test::ping(2)));
  EXPECT_TRUE(from_operator(test::with_sum(test::ping(1)))) << "it is refused, but signed";
  EXPECT_TRUE(from_operator(test::with_sum(test::set_mode(99, 3))));
  EXPECT_FALSE(from_operator(Stream{1, 2, 3}));
}

TEST(CommandReceiver, LooksBehindWhatItGivesUp) {
  VERIFIES("LASSO-LNK-028~1");
  CommandReceiver receiver;
  EXPECT_FALSE(receiver.give_up());
  Stream stream = test::offer_start(StartCommand{});
  stream.resize(50);
  test::append(stream, test::ping());
  receiver.take(view(stream));
  ASSERT_TRUE(receiver.packet().empty());
  ASSERT_TRUE(receiver.give_up());
  EXPECT_EQ(accept(receiver, Stream(receiver.packet().begin(), receiver.packet().end())), PacketFault::kNone);
}

}  // namespace
}  // namespace lasso
