#include "fsw/link/commands.hpp"

#include <limits>

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"

namespace lasso {
namespace {

using test::every_command;
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

TEST(Commands, ArriveAsTheyWereSent) {
  VERIFIES("LASSO-LNK-023~2");
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
  start.source = 4;
  start.t_us = 123456789;
  start.covariance[20] = 0.5F;
  ASSERT_EQ(decode(test::offer_start(start), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kStart);
  EXPECT_EQ(command.start.source, 4);
  EXPECT_EQ(command.start.t_us, 123456789);
  EXPECT_EQ(command.start.covariance[20], 0.5F);
  ASSERT_EQ(decode(test::disable_event(3), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kDisableEvent);
  EXPECT_EQ(command.event.event, 3);
  ASSERT_EQ(decode(test::enable_event(2), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kEnableEvent);
  ASSERT_EQ(decode(test::report_disabled(), command), PacketFault::kNone);
  EXPECT_EQ(command.kind, CommandKind::kReportDisabled);
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
  const Stream disable = test::disable_event(0x0102);
  EXPECT_EQ(Stream(disable.begin() + 7, disable.begin() + 13), (Stream{5, 6, 0, 0, 1, 2}));
  EXPECT_EQ(test::enable_event(1)[8], 5);
  EXPECT_EQ(test::report_disabled()[8], 7);
  const Stream arm = test::arm({1, 2, 0x0304});
  EXPECT_EQ(Stream(arm.begin() + 7, arm.begin() + 17), (Stream{8, 1, 0, 0, 0, 4, 1, 2, 3, 4}));
  const Stream period = test::set_period(2, 0x0506);
  EXPECT_EQ(Stream(period.begin() + 7, period.begin() + 15), (Stream{3, 31, 0, 0, 0, 2, 5, 6}));
  const Stream time = test::correlate_time(1, 0x0102030405);
  EXPECT_EQ(Stream(time.begin() + 7, time.begin() + 27), (Stream{9, 128, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 2, 3, 4, 5}));
  for (const PacketRow& packet : kPackets) {
    if (packet.type == PacketType::kCommand) {
      EXPECT_LE(item_offset(packet, packet.items.size()) + kPacketTrailerBytes, kMaxCommandBytes - kMaxAuthenticationBytes);
    }
  }
}

TEST(Commands, EncodeDecodeEncodeIsByteIdentical) {
  VERIFIES("LASSO-LNK-023~2");
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
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 99)), PacketFault::kUnknown);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 3)), PacketFault::kBadLength);
  EXPECT_EQ(fault_of(with_byte(test::set_mode(1), 12, 0)), PacketFault::kUnknown) << "ping is no function";
  Stream longer = test::ping();
  longer.insert(longer.begin() + 11, 0);
  longer[5] = static_cast<std::uint8_t>(longer[5] + 1);
  EXPECT_EQ(fault_of(with_byte(longer, 11, 0)), PacketFault::kBadLength);
}

TEST(Commands, HazardousOnesAreThese) {
  VERIFIES("LASSO-LNK-017~2");
  EXPECT_TRUE(is_hazardous({8, 1, 5})) << "enable_laser";
  EXPECT_FALSE(is_hazardous({8, 1, 6})) << "the laser is inhibited at once";
  EXPECT_FALSE(is_hazardous({8, 1, 4}));
  EXPECT_FALSE(is_hazardous({8, 2, 5}));
  EXPECT_FALSE(is_hazardous({9, 1, 5}));
  std::string once, renewed;
  for (const Stream& packet : every_command()) {
    Command each;
    ASSERT_EQ(decode(packet, each), PacketFault::kNone);
    EXPECT_EQ(is_hazardous(each.name), each.hazard != Hazard::kNone);
    if (each.hazard == Hazard::kOnce) once += std::string(command_rows::row_of(each.kind).name) + " ";
    if (each.hazard == Hazard::kRenewed) renewed += std::string(command_rows::row_of(each.kind).name) + " ";
  }
  EXPECT_EQ(once, "enable_laser activate_image roll_back_image reset change_key ");
  EXPECT_EQ(renewed, "load_memory ");
  Command command;
  ASSERT_EQ(decode(test::plain_packet(CommandKind::kEnableLaser), command), PacketFault::kNone);
  EXPECT_EQ(command.hazard, Hazard::kOnce);
  EXPECT_TRUE((command.name == CommandName{8, 1, 5}));
  ASSERT_EQ(decode(test::ping(), command), PacketFault::kNone);
  EXPECT_EQ(command.hazard, Hazard::kNone);
}

TEST(Commands, RowsStandInTheOrderOfTheirKinds) {
  VERIFIES("LASSO-LNK-002~1");
  std::size_t commands = 0;
  for (const PacketRow& packet : kPackets) commands += packet.type == PacketType::kCommand ? 1 : 0;
  EXPECT_EQ(every_command().size(), commands);
  for (const Stream& packet : every_command()) {
    Command command;
    ASSERT_EQ(decode(packet, command), PacketFault::kNone);
    const PacketRow& row = command_rows::row_of(command.kind);
    EXPECT_EQ(row.service, command.header.service);
    EXPECT_EQ(row.subservice, command.header.subservice);
    EXPECT_EQ(item_offset(row, row.items.size()) + kPacketTrailerBytes, packet.size()) << row.name;
  }
}

TEST(Commands, TwoOfThemMakeSafe) {
  VERIFIES("LASSO-LNK-040~2");
  std::string urgent;
  for (const Stream& packet : every_command()) {
    Command command;
    ASSERT_EQ(decode(packet, command), PacketFault::kNone);
    if (is_urgent(view(packet))) urgent += std::string(command_rows::row_of(command.kind).name) + " ";
  }
  EXPECT_EQ(urgent, "inhibit_laser ") << "set_mode has another mode here";
  EXPECT_TRUE(is_urgent(view(test::set_mode(kSafeMode))));
  EXPECT_FALSE(is_urgent(view(test::set_mode(kSafeMode - 1))));
  Stream damaged = test::set_mode(kSafeMode);
  damaged.back() ^= 1;
  EXPECT_FALSE(is_urgent(view(damaged)));
}

TEST(Commands, ArgumentsOutOfRangeAreRefused) {
  VERIFIES("LASSO-LNK-034~1");
  EXPECT_EQ(fault_of(test::enable_event(kEvents)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::set_period(kStructures, 1)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::correlate_time(0, -1)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::correlate_time(4294967296000001, 0)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::set_mode(11)), PacketFault::kBadArgument);
  EXPECT_EQ(fault_of(test::set_hold(2)), PacketFault::kBadArgument);
  StartCommand start;
  start.source = 6;
  EXPECT_EQ(fault_of(test::offer_start(start)), PacketFault::kBadArgument);
  start.source = 5;
  start.v_mps[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(test::offer_start(start)), PacketFault::kBadArgument);
}

}  // namespace
}  // namespace lasso
