#include "fsw/link/commands.hpp"

#include <limits>

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"

namespace lasso {
namespace {

using test::Stream;
using test::view;

// Kind 99 stands for a command that is untouched.
PacketFault decode(const Stream& packet, Command& command) {
  command = Command{};
  command.header.source = 99;
  const PacketFault fault = decode_command(view(packet), command);
  if (fault != PacketFault::kNone) {
    EXPECT_EQ(command.header.source, 99) << "untouched when refused";
  }
  return fault;
}

PacketFault fault_of(const Stream& packet) {
  Command command;
  return decode(packet, command);
}

Stream with_byte(Stream packet, std::size_t index, std::uint8_t value) {
  packet[index] = value;
  test::repair_crc(packet);
  return packet;
}

std::vector<Stream> every_command() { return {test::ping(), test::set_mode(5), test::set_hold(1), test::offer_start(StartCommand{})}; }

TEST(Commands, ArriveAsTheyWereSent) {
  VERIFIES("LASSO-LNK-023~1");
  Command command;
  ASSERT_EQ(decode(test::ping(7), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kPing);
  EXPECT_EQ(command.header.sequence_count, 7);
  ASSERT_EQ(decode(test::set_mode(7), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kMode);
  EXPECT_EQ(command.mode.mode, 7);
  ASSERT_EQ(decode(test::set_hold(1), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kHold);
  EXPECT_EQ(command.hold.held, 1);
  StartCommand start;
  start.way = 4;
  start.t_us = 123456789;
  start.covariance[20] = 0.5F;
  ASSERT_EQ(decode(test::offer_start(start), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kStart);
  EXPECT_EQ(command.start.way, 4);
  EXPECT_EQ(command.start.t_us, 123456789);
  EXPECT_EQ(command.start.covariance[20], 0.5F);
}

TEST(Commands, LieAtTheseBytes) {
  VERIFIES("LASSO-LNK-002~1");
  // Written down by hand: who changes the layout changes an interface.
  EXPECT_EQ(test::ping().size(), 13u);
  EXPECT_EQ(test::set_mode(0).size(), 16u);
  EXPECT_EQ(test::set_mode(5)[13], 5);
  EXPECT_EQ(test::set_mode(0)[12], 1) << "the number of the function";
  EXPECT_EQ(test::set_hold(1)[12], 2);
  EXPECT_EQ(test::offer_start(StartCommand{}).size(), 212u);
  EXPECT_EQ(test::offer_start(StartCommand{})[12], 3);
  for (const PacketRow& packet : kPackets) {
    if (packet.type == PacketType::kCommand) {
      EXPECT_LE(item_offset(packet, packet.items.size()) + kPacketTrailerBytes, kMaxCommandBytes);
    }
  }
}

TEST(Commands, EncodeDecodeEncodeIsByteIdentical) {
  VERIFIES("LASSO-LNK-023~1");
  test::Generator random(17);
  const Stream blank = test::offer_start(StartCommand{});
  int accepted = 0;
  for (int i = 0; i < 1000; ++i) {
    Stream packet = blank;
    for (std::size_t j = 13; j + kPacketTrailerBytes < packet.size(); ++j) packet[j] = static_cast<std::uint8_t>(random.below(256));
    packet[13] = static_cast<std::uint8_t>(random.below(6));
    test::repair_crc(packet);
    Command command;
    if (decode(packet, command) != PacketFault::kNone) continue;  // not a number
    ++accepted;
    ASSERT_EQ(test::offer_start(command.start), packet);
  }
  EXPECT_GT(accepted, 700);
  for (std::uint8_t value = 0; value < 9; ++value) {
    Command command;
    ASSERT_EQ(decode(test::set_mode(value), command), PacketFault::kNone);
    ASSERT_EQ(test::set_mode(command.mode.mode), test::set_mode(value));
  }
}

TEST(Commands, EveryTruncationAndEveryBitErrorIsRefused) {
  VERIFIES("LASSO-LNK-034~1");
  for (const Stream& good : every_command()) {
    for (std::size_t n = 0; n < good.size(); ++n)
      ASSERT_NE(fault_of(Stream(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n))), PacketFault::kNone);
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
      Stream damaged = good;
      damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
      ASSERT_NE(fault_of(damaged), PacketFault::kNone) << "bit " << bit;
    }
  }
}

TEST(Commands, WhatIsNoneIsNamed) {
  VERIFIES("LASSO-LNK-034~1");
  EXPECT_EQ(fault_of(with_byte(test::ping(), 7, 18)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::ping(), 8, 2)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 7, 9)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 8, 2)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 9)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 3)), PacketFault::kBadLength);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 0)), PacketFault::kUnknown) << "ping is no function";
  Stream longer = test::ping();
  longer.insert(longer.begin() + 11, 0);
  longer[5] = static_cast<std::uint8_t>(longer[5] + 1);
  EXPECT_EQ(fault_of(with_byte(longer, 11, 0)), PacketFault::kBadLength);
}

TEST(Commands, ArgumentsOutOfRangeAreRefused) {
  VERIFIES("LASSO-LNK-034~1");
  EXPECT_EQ(fault_of(test::set_mode(9)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::set_hold(2)), PacketFault::kBadArgument);
  StartCommand start;
  start.way = 6;
  EXPECT_EQ(fault_of(test::offer_start(start)), PacketFault::kBadArgument);
  start.way = 5;
  start.v_mps[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(test::offer_start(start)), PacketFault::kBadArgument);
}

}  // namespace
}  // namespace lasso
