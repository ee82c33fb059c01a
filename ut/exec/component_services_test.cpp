// Services by the link alone: hazardous commands, housekeeping, time.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ut/exec/component_operator.hpp"
#include "ut/support/box_frames.hpp"

namespace lasso {
namespace {

using test::events_of;
using test::Link;
using test::Packet;
using test::refusal_of;
using test::Stream;
using test::told;

std::uint8_t number(ServiceRefusal refusal) { return static_cast<std::uint8_t>(refusal); }

std::size_t poses(const std::vector<Packet>& packets) {
  return static_cast<std::size_t>(std::count_if(
      packets.begin(), packets.end(), [](const Packet& packet) { return packet.is(3, 25) && packet.data[1] == kPoseStructureId; }));
}

TEST(ComponentServices, TheLaserIsInhibitedUntilItIsArmedAndEnabled) {
  VERIFIES("LASSO-LNK-017~1 LASSO-LCS-006~1");
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

// Where in a component's memory the permission lies in its copies: the last place that says so, behind the mode, which may be 1, too.
std::uint32_t* copies_of_permission(Component& component) {
  constexpr std::uint32_t kCopies[] = {1, ~1u, 1};
  auto* words = reinterpret_cast<std::uint32_t*>(&component);
  auto* end = words + sizeof(Component) / sizeof(std::uint32_t);
  auto* found = std::find_end(words, end, kCopies, kCopies + 3);
  EXPECT_NE(found, end);
  return found;
}

TEST(ComponentServices, AFlippedBitOfTheLasersPermissionIsOutvotedToldAndRepaired) {
  VERIFIES("LASSO-HLT-013~1");
  Link link;
  link.send(test::arm(CommandKind::kEnableLaser, 1));
  link.send(test::plain_packet(CommandKind::kEnableLaser, 2));
  link.run_frame();
  std::uint32_t* const copies = copies_of_permission(*link.scene.component);
  for (std::size_t bit = 0; bit < 96; bit += 13) {  // as many as a window of the event tells
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

TEST(ComponentServices, ModeSafeKeepsTheLaserDark) {
  VERIFIES("LASSO-HLT-002~1 LASSO-LNK-017~1");
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

TEST(ComponentServices, AnArmThatIsNotUsedExpiresAndSaysSo) {
  VERIFIES("LASSO-LNK-017~1");
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

TEST(ComponentServices, TheLinkStructureSaysWhatIsArmedAndEnabled) {
  VERIFIES("LASSO-LNK-017~1");
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

TEST(ComponentServices, StructuresAreDisabledEnabledGivenAPeriodAndAskedForOnce) {
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
TEST(ComponentServices, TheWholeStreamFits64KilobitsASecond) {
  VERIFIES("LASSO-LNK-031~1");
  Link link;
  std::size_t bytes = 0, fewer = 0;
  for (std::uint16_t frame = 0; frame < 50; ++frame) {
    link.send(test::set_mode(99, frame));
    for (const Packet& packet : link.run_frame()) bytes += packet.data.size() + 22;
  }
  EXPECT_GT(bytes, 48U * 835);
  EXPECT_LE(bytes * 8, 64000U * 10) << "50 frames of 0.2 s";
  link.send(test::set_period(kPoseStructureId, 5, 100));
  for (int frame = 0; frame < 50; ++frame) {
    for (const Packet& packet : link.run_frame()) fewer += packet.data.size() + 22;
  }
  EXPECT_LT(fewer * 4, bytes) << "the rate is selectable";
}

// Of each pair in the image, and of the same scan as the packet pose; none without.
TEST(ComponentServices, PosesBetweenNamedFramesAreSentWhereTheImageNamesThem) {
  VERIFIES("LASSO-LNK-050~1 LASSO-LNK-051~1");
  const test::BoxScene truth = test::default_scene();
  const NamedFrame docking = test::grapple_in_port();
  const test::BoxTables tables = test::make_box_tables(truth.boxes());
  const auto image = [&](const std::vector<NamedFrame>& frames) {
    return test::make_image(test::box_parameters(truth), test::with_frames(tables, frames));
  };
  test::ComponentScene without(truth, image({}));
  without.begin();
  test::ComponentScene scene(truth, image({NamedFrame{}, docking}));
  scene.begin();
  const auto named = [](test::ComponentScene& of) {
    std::vector<NamedPoseTelemetry> poses;
    for (const Packet& packet : test::packets_of(test::run_frame(*of.component))) {
      if (!packet.is(3, 25) || packet.data[1] != kNamedPoseStructureId) continue;
      ByteReader in(test::view(packet.data));
      in.u16();
      codec_of(named_pose_rows::kRows).read(in, poses.emplace_back());
    }
    return poses;
  };
  std::size_t told = 0;
  for (int frame = 0; frame < 8; ++frame) {
    EXPECT_TRUE(named(without).empty());
    const auto poses = named(scene);
    if (poses.empty()) continue;
    ASSERT_EQ(poses.size(), 2U);
    EXPECT_EQ(poses[0].pair, 1);
    EXPECT_EQ(poses[1].pair, 2);
    EXPECT_EQ(poses[1].pairs, 2);
    EXPECT_EQ(poses[1].valid, 1);
    EXPECT_EQ(poses[1].started, 1);
    const Pose T_in_of = docking.T_in_sensor * truth.pose_at(poses[1].t_measurement_us) * docking.T_target_of;
    EXPECT_LT((Vec3(poses[1].p_in_of_m) - T_in_of.p).norm(), 3e-3);
    EXPECT_LT((Vec3(poses[1].filter_p_in_of_m) - T_in_of.p).norm(), 3e-3);
    EXPECT_LT((Vec3(poses[0].p_in_of_m) - truth.pose_at(poses[0].t_measurement_us).p).norm(), 3e-3);
    ++told;
  }
  EXPECT_GE(told, 5U);
  const auto send = [&](CommandKind kind, std::uint16_t count) {
    const Stream bytes = test::of_structure(kind, kNamedPoseStructureId, count);
    scene.component->receive(test::view(bytes), scene.component->next_slot_us());
  };
  auto* const image_bytes = const_cast<std::uint8_t*>(scene.component->images().active().sealed_image().data());
  test::TestImage as_sent = image({NamedFrame{}, docking});
  std::uint8_t* const decayed = image_bytes + test::table_offset(as_sent, static_cast<std::uint32_t>(TableId::kNamedFrames));
  std::uint8_t before[8];  // of the first quaternion's x
  std::copy_n(decayed, 8, before);
  std::fill_n(decayed, 8, std::uint8_t{0x7F});
  ASSERT_EQ(named(scene).size(), 1U) << "what has decayed is not told";
  std::copy_n(before, 8, decayed);
  send(CommandKind::kDisableStructure, 0);
  EXPECT_TRUE(named(scene).empty());
  send(CommandKind::kReportStructure, 1);
  EXPECT_EQ(named(scene).size(), 2U);
}

// What is told of its diagonal is what the packet pose of the same frame tells as sigmas.
TEST(ComponentServices, TheFiltersCovarianceIsSentOnRequest) {
  VERIFIES("LASSO-LNK-039~1");
  Link link;
  std::vector<Packet> frame;
  const auto filters = [&] {
    frame = link.run_frame();
    std::vector<FilterTelemetry> reports;
    for (const Packet& packet : frame) {
      if (!packet.is(3, 25) || packet.data[1] != kFilterStructureId) continue;
      ByteReader in(test::view(packet.data));
      in.u16();
      codec_of(filter_rows::kRows).read(in, reports.emplace_back());
    }
    return reports;
  };
  link.send(test::of_structure(CommandKind::kReportStructure, kFilterStructureId, 0));
  const auto early = filters();
  ASSERT_EQ(early.size(), 1u) << "before any scan, too";
  EXPECT_EQ(early[0].accepted, 0u);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(filters().empty());
  link.send(test::of_structure(CommandKind::kEnableStructure, kFilterStructureId, 1));
  for (int i = 0; i < 3; ++i) {
    const auto reports = filters();
    ASSERT_EQ(reports.size(), 1u);
    const PoseTelemetry pose = link.pose_of(frame);
    EXPECT_EQ(reports[0].scan_id, pose.scan_id);
    EXPECT_EQ(reports[0].t_us, pose.t_measurement_us);
    EXPECT_EQ(reports[0].started, 1);
    std::size_t term = 0;
    for (std::size_t row = 0; row < 12; term += 12 - row, ++row) {
      const float sigma = row < 6 ? pose.filter_sigma_pose[row] : pose.filter_sigma_rates[row - 6];
      EXPECT_NEAR(std::sqrt(reports[0].covariance[term]), sigma, 1e-6F * sigma) << row;
    }
  }
}

TEST(ComponentServices, APoseIsReportedInStandbyWhenAskedFor) {
  VERIFIES("LASSO-LNK-014~1");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kStandby), 0));
  link.send(test::of_structure(CommandKind::kReportStructure, kPoseStructureId, 1));
  EXPECT_EQ(poses(link.run_frame()), 1u) << "before any scan";
  for (int frame = 0; frame < 3; ++frame) link.run_frame();
  EXPECT_EQ(poses(link.run_frame()), 0u);
  link.send(test::of_structure(CommandKind::kReportStructure, kPoseStructureId, 2));
  const std::vector<Packet> frame = link.run_frame();
  ASSERT_EQ(poses(frame), 1u);
  EXPECT_EQ(link.pose_of(frame).scan_id, 3u) << "the number of the scan that would be due";
}

TEST(ComponentServices, PosesThatAreNotSentCountAndTheirChangesAreEvents) {
  VERIFIES("LASSO-LNK-014~1 LASSO-MOD-172~1");
  Link link;
  link.send(test::of_structure(CommandKind::kDisableStructure, kPoseStructureId, 0));
  std::size_t changes = 0;
  std::uint16_t count = 1;
  for (int frame = 0; frame < 40; ++frame) {  // more changes than a packet could tell
    const TrackingMode mode = frame % 2 == 0 ? TrackingMode::kBearing : TrackingMode::kStandby;
    link.send(test::set_mode(static_cast<std::uint8_t>(mode), count++));
    const std::vector<Packet> packets = link.run_frame();
    EXPECT_EQ(poses(packets), 0u);
    for (const Stream& event : events_of(packets)) changes += event[1] == 2 ? 1U : 0U;
  }
  EXPECT_GE(changes, 39u);
}

TEST(ComponentServices, HeadersStateSpacecraftTimeOnceItIsCorrelated) {
  VERIFIES("LASSO-LNK-037~1 LASSO-HLT-006~1");
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
  for (const Packet& packet : link.answers()) {
    EXPECT_EQ(packet.header.t_us, jumped_us) << "a clock that jumped is correlated with nothing";
    EXPECT_EQ(packet.header.time_status, 0);
  }
}

// Each report by its bit, in the order of what happens.
TEST(ComponentServices, ReportsOfACommandAreThoseThatItAsksFor) {
  VERIFIES("LASSO-LNK-013~1");
  constexpr std::uint8_t kBits[] = {kAcknowledgeAcceptance, kAcknowledgeStart, kAcknowledgeCompletion};
  constexpr std::uint8_t kReports[] = {kSubserviceAccepted, kSubserviceStarted, kSubserviceCompleted};
  for (std::uint8_t asked = 0; asked < 16; ++asked) {
    Link link;
    Stream packet = test::ping(7);
    packet[6] = static_cast<std::uint8_t>((packet[6] & 0xF0) | asked);
    ByteWriter writer{Bytes(packet.data(), packet.size())};
    for (std::size_t i = 0; i + kPacketTrailerBytes < packet.size(); ++i) writer.u8(packet[i]);
    finish_packet(writer, Bytes(packet.data(), packet.size()));
    link.send(packet);
    Stream said, expected;
    for (const Packet& answer : link.answers()) {
      if (!answer.is(17, 2)) said.push_back(answer.header.subservice);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if ((asked & kBits[i]) != 0) expected.push_back(kReports[i]);
    }
    EXPECT_EQ(said, expected) << static_cast<int>(asked);
  }
}

}  // namespace
}  // namespace lasso
