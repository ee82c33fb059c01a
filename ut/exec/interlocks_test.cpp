// Hazardous commands and the laser, by the link alone.
#include <algorithm>

#include "ut/exec/component_operator.hpp"

namespace lasso {
namespace {

using test::Link;
using test::Packet;
using test::refusal_of;
using test::told;

std::uint8_t number(ServiceRefusal refusal) { return static_cast<std::uint8_t>(refusal); }

TEST(Interlocks, TheLaserIsInhibitedUntilItIsArmedAndEnabled) {
  VERIFIES("LASSO-LNK-017~2 LASSO-LCS-006~1 LASSO-HLT-009~2");
  Link link;
  EXPECT_FALSE(link.scene.sensor.laser_permitted) << "from the start";
  link.send(test::plain_packet(CommandKind::kEnableLaser, 1));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNotArmed));
  EXPECT_FALSE(link.scene.sensor.laser_permitted);
  link.send(test::arm(CommandKind::kEnableLaser, 2));
  EXPECT_EQ(refusal_of(link.answers()), 0);
  EXPECT_FALSE(link.scene.sensor.laser_permitted) << "armed, not fired";
  const std::vector<Packet> frame = link.run_frame();
  EXPECT_TRUE(told(frame, EventId::kCommandArmed));
  EXPECT_EQ(link.pose_of(frame).scan_id, 0u);
  link.send(test::plain_packet(CommandKind::kEnableLaser, 3));
  EXPECT_EQ(refusal_of(link.answers()), 0);
  EXPECT_TRUE(link.scene.sensor.laser_permitted);
  EXPECT_TRUE(told(link.run_frame(), EventId::kLaserEnabled));
  link.send(test::plain_packet(CommandKind::kInhibitLaser, 4));
  EXPECT_FALSE(link.scene.sensor.laser_permitted) << "at once, and unarmed";
  EXPECT_TRUE(told(link.run_frame(), EventId::kLaserInhibited));
  link.send(test::plain_packet(CommandKind::kInhibitLaser, 5));
  EXPECT_FALSE(told(link.run_frame(), EventId::kLaserInhibited)) << "it was";
  link.send(test::plain_packet(CommandKind::kEnableLaser, 6));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNotArmed)) << "an arm serves once";
}

// Where in a component's memory the permission lies in its copies: the first place that says so, before the mode, which may be 1, too.
std::uint32_t* copies_of_permission(Component& component) {
  constexpr std::uint32_t kCopies[] = {1, ~1u, 1};
  auto* words = reinterpret_cast<std::uint32_t*>(&component);
  auto* end = words + sizeof(Component) / sizeof(std::uint32_t);
  auto* found = std::search(words, end, kCopies, kCopies + 3);
  EXPECT_NE(found, end);
  return found;
}

TEST(Interlocks, AFlippedBitOfTheLasersPermissionIsOutvotedToldAndRepaired) {
  VERIFIES("LASSO-HLT-013~1");
  Link link;
  link.send(test::arm(CommandKind::kEnableLaser, 1));
  link.send(test::plain_packet(CommandKind::kEnableLaser, 2));
  link.run_frame();
  std::uint32_t* const copies = copies_of_permission(*link.scene.component);
  for (std::size_t bit = 0; bit < 96; bit += 13) {  // as many as a window of the event reports
    copies[bit / 32] ^= 1u << bit % 32;
    EXPECT_TRUE(told(link.run_frame(), EventId::kFaultConfirmed)) << bit;
    EXPECT_TRUE(link.scene.component->faults().active().has(Fault::kLaserCorrupt));
    EXPECT_EQ(copies[0], 1u);
    EXPECT_EQ(copies[1], ~1u);
    EXPECT_EQ(copies[2], 1u);
    EXPECT_TRUE(link.scene.sensor.laser_permitted);
    link.run_frame();
    EXPECT_TRUE(link.scene.component->faults().active().empty()) << "repaired";
  }
  copies[0] = 0;
  copies[1] = 5;
  link.run_frame();
  EXPECT_FALSE(link.scene.sensor.laser_permitted) << "no two agree";
  EXPECT_EQ(copies[0], 0u);
  link.send(test::arm(CommandKind::kEnableLaser, 3));
  link.send(test::plain_packet(CommandKind::kEnableLaser, 4));
  EXPECT_TRUE(told(link.run_frame(), EventId::kLaserEnabled)) << "an operator has to permit it again";
}

TEST(Interlocks, ModeSafeKeepsTheLaserDark) {
  VERIFIES("LASSO-HLT-002~1 LASSO-LNK-017~2");
  Link link;
  link.send(test::arm(CommandKind::kEnableLaser, 0));
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kSafe), 1));
  link.send(test::arm(CommandKind::kEnableLaser, 2));
  link.answers();
  link.send(test::plain_packet(CommandKind::kEnableLaser, 3));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kModeSafe)) << "asked for in this frame";
  link.send(test::arm(CommandKind::kEnableLaser, 4));
  link.run_frame();
  link.answers();
  link.send(test::plain_packet(CommandKind::kEnableLaser, 5));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNotArmed)) << "making safe disarms";
  link.send(test::arm(CommandKind::kEnableLaser, 6));
  link.answers();
  link.send(test::plain_packet(CommandKind::kEnableLaser, 7));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kModeSafe));
  EXPECT_FALSE(link.scene.sensor.laser_permitted);
}

TEST(Interlocks, AnArmThatIsNotUsedExpiresAndSaysSo) {
  VERIFIES("LASSO-LNK-017~2");
  Link link;
  link.send(test::arm(CommandKind::kEnableLaser, 0));
  int expired_at = -1;
  for (int frame = 0; frame < 60; ++frame) {
    if (told(link.run_frame(), EventId::kArmExpired)) expired_at = frame;
  }
  EXPECT_EQ(expired_at, static_cast<int>(kArmFrames) - 1);
  link.send(test::plain_packet(CommandKind::kEnableLaser, 1));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNotArmed));
  link.send(test::arm(CommandKind::kPing, 2));
  EXPECT_EQ(refusal_of(link.answers()), number(ServiceRefusal::kNotHazardous));
}

TEST(Interlocks, TheLinkStructureSaysWhatIsArmedAndEnabled) {
  VERIFIES("LASSO-LNK-017~2");
  Link link;
  const auto link_of = [&] {
    LinkTelemetry telemetry;
    for (const Packet& packet : link.run_frame()) {
      if (!packet.is(3, 25) || packet.data[1] != kLinkStructureId) continue;
      ByteReader in(test::view(packet.data));
      in.u16();
      codec_of(link_report_rows::kLink).read(in, telemetry);
    }
    return telemetry;
  };
  link.send(test::arm(CommandKind::kEnableLaser, 0));
  EXPECT_EQ(link_of().armed, 1);
  link.send(test::plain_packet(CommandKind::kEnableLaser, 1));
  const LinkTelemetry after = link_of();
  EXPECT_EQ(after.armed, 0);
  EXPECT_EQ(after.laser_enabled, 1);
  EXPECT_EQ(after.accepted_commands, 2u);
}

// Without a component around it: what the sensors are told, and what its copies say.
class InterlocksTest : public ::testing::Test {
 protected:
  SensorBank both() {
    SensorBank bank = only(first);
    EXPECT_TRUE(bank.push_back(&second));
    return bank;
  }
  std::size_t raised(EventId id) {
    const Span<const EventRecord> records = telemetry.events().records();
    return static_cast<std::size_t>(
        std::count_if(records.begin(), records.end(), [&](const EventRecord& event) { return event.id == id; }));
  }
  test::BoxSensor first{test::default_scene()}, second{test::default_scene()};
  AcquisitionTask acquisition{both()};
  Telemetry telemetry{kApid};
  Interlocks interlocks{acquisition, telemetry};
};

TEST_F(InterlocksTest, EachSensorIsPermittedAndInhibited) {
  VERIFIES("LASSO-LCS-006~1");
  EXPECT_FALSE(interlocks.laser_enabled());
  interlocks.enable_laser();
  EXPECT_TRUE(interlocks.laser_enabled());
  EXPECT_TRUE(first.laser_permitted && second.laser_permitted);
  interlocks.inhibit_laser();
  EXPECT_FALSE(interlocks.laser_enabled());
  EXPECT_FALSE(first.laser_permitted || second.laser_permitted);
  interlocks.inhibit_laser();
  EXPECT_EQ(raised(EventId::kLaserInhibited), 1u) << "the second time it was inhibited already";
}

TEST_F(InterlocksTest, AHazardousCommandUsesUpItsArmAndInhibitingTheLaserTakesItAway) {
  VERIFIES("LASSO-LNK-017~2");
  Command command;
  EXPECT_TRUE(interlocks.may_carry_out(command)) << "not hazardous";
  command.hazard = Hazard::kOnce;
  EXPECT_FALSE(interlocks.may_carry_out(command));
  const PacketRow& row = command_rows::row_of(CommandKind::kEnableLaser);
  command.name = {row.service, row.subservice, row.number};
  ASSERT_EQ(interlocks.arm(command.name), ServiceRefusal::kNone);
  EXPECT_TRUE(interlocks.armed());
  EXPECT_TRUE(interlocks.may_carry_out(command));
  EXPECT_FALSE(interlocks.may_carry_out(command)) << "an arm serves once";
  ASSERT_EQ(interlocks.arm(command.name), ServiceRefusal::kNone);
  interlocks.inhibit_laser();
  EXPECT_FALSE(interlocks.may_carry_out(command));
}

}  // namespace
}  // namespace lasso
