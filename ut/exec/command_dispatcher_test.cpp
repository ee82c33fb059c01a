// Commands by the link alone, and what telemetry answers.
#include "ut/exec/component_operator.hpp"
#include "ut/link/keyed_sum.hpp"
#include "ut/support/generator.hpp"

namespace lasso {
namespace {

using test::events_of;
using test::Link;
using test::Packet;
using test::Stream;
using test::true_start;
using test::view;

TEST(CommandDispatcher, PingIsAnswered) {
  VERIFIES("LASSO-LNK-013~2 LASSO-LNK-011~2");
  Link link;
  EXPECT_EQ(link.send(test::ping(7)), test::ping(7).size());
  const std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_TRUE(answers[0].is(1, 1));
  EXPECT_EQ(answers[0].data, (Stream{0x1B, 0xD1, 0xC0, 0x07}));
  EXPECT_TRUE(answers[1].is(17, 2));
  EXPECT_TRUE(answers[2].is(1, 7));
  for (std::uint16_t i = 0; i < 3; ++i) {
    EXPECT_EQ(answers[i].header.sequence_count, i);
    EXPECT_EQ(answers[i].header.message_count, 0) << "of its own kind";
  }
}

TEST(CommandDispatcher, WithAnAuthenticatorOnlyItsCommandsAreCarriedOut) {
  VERIFIES("LASSO-LNK-021~2");
  Link link;
  test::KeyedSum authenticator;
  link.component().use_authenticator(authenticator);
  link.send(test::ping(7));
  const std::vector<Packet> refused = link.answers();
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_TRUE(refused[0].is(1, 2));
  EXPECT_EQ(refused[0].data.back(), static_cast<std::uint8_t>(PacketFault::kNotAuthentic));
  link.send(test::with_sum(test::ping(7)));
  const std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_TRUE(answers[1].is(17, 2));
}

TEST(CommandDispatcher, ALinkThatIsSilentForLongIsAFaultWhereTheMissionSaysSo) {
  VERIFIES("LASSO-HLT-001~1");
  for (const double silence_max_s : {0.0, 1.1}) {
    MissionParameters p = test::box_parameters(test::default_scene());
    p.link_silence_max_s = silence_max_s;
    test::ComponentScene scene(p);
    scene.begin();
    std::string silent;
    for (std::uint16_t frame = 0; frame < 20; ++frame) {
      const Stream command = frame == 9 ? test::set_mode(99, 1) : test::ping(1);
      if (frame == 9 || frame == 11) {
        EXPECT_TRUE(scene.component->receive_packet(view(command), scene.component->next_slot_us()));
      }
      scene.run_frame();
      silent += scene.component->faults().active().has(Fault::kLinkSilent) ? '!' : '.';
    }
    EXPECT_EQ(silent, silence_max_s > 0 ? "......!!!!!......!!!" : "....................")
        << "a command that is refused is no sign of life";
  }
}

TEST(CommandDispatcher, ReportsAreSentAsAskedFor) {
  VERIFIES("LASSO-LNK-013~2");
  Link link;
  for (const std::uint8_t asked : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{8}, std::uint8_t{9}}) {
    Stream packet = test::set_hold(1, asked);
    packet[6] = static_cast<std::uint8_t>(0x20 | asked);
    test::repair_crc(packet);
    link.send(packet);
    const std::vector<Packet> answers = link.answers();
    ASSERT_EQ(answers.size(), (asked & 1u) + (asked >> 3));
    if ((asked & 1) != 0) {
      EXPECT_TRUE(answers.front().is(1, 1));
    }
    if ((asked & 8) != 0) {
      EXPECT_TRUE(answers.back().is(1, 7));
    }
  }
  const auto answer_of_what_asks_for_none = [&](Stream packet) {
    packet[6] = 0x20;
    test::repair_crc(packet);
    link.send(packet);
    const std::vector<Packet> answers = link.answers();
    return answers.size() == 1 && answers[0].header.service == 1 ? answers[0].header.subservice : 0;
  };
  EXPECT_EQ(answer_of_what_asks_for_none(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kReacquiring), 10)), kSubserviceFailed);
  EXPECT_EQ(answer_of_what_asks_for_none(test::set_mode(99, 11)), kSubserviceRefused);
}

TEST(CommandDispatcher, AStartByUplinkIsTrackedFromTheNextBoundaryOn) {
  VERIFIES("LASSO-LNK-022~2 LASSO-LNK-011~2");
  Link link;
  link.run_frame();
  link.send(test::offer_start(true_start(0)));
  const std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[1].is(1, 7));
  link.run_frame();
  link.run_frame();
  const PoseTelemetry pose = link.pose_of(link.run_frame());
  EXPECT_EQ(pose.scan_id, 1u) << "the scan of the frame behind the command";
  EXPECT_EQ(pose.valid, 1);
  EXPECT_EQ(pose.start_source, static_cast<std::uint8_t>(InitialPoseSource::kUplink));
  EXPECT_LT(link.scene.error(pose).norm(), 1e-2);
}

TEST(CommandDispatcher, ACommandedModeIsTakenAtTheNextBoundary) {
  VERIFIES("LASSO-LNK-022~2 LASSO-MOD-173~2");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kBearing)));
  link.send(test::set_hold(1, 1));
  link.run_frame();
  link.run_frame();
  const PoseTelemetry pose = link.pose_of(link.run_frame());
  EXPECT_EQ(pose.mode, static_cast<std::uint8_t>(TrackingMode::kBearing));
  EXPECT_EQ(pose.held, 1);
  EXPECT_EQ(pose.scan_id, 0u);
}

TEST(CommandDispatcher, WhatThePresentStateDoesNotAllowFailsWithItsReason) {
  VERIFIES("LASSO-LNK-013~2");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kReacquiring)));
  std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[1].is(1, 8));
  EXPECT_EQ(answers[1].data[4], static_cast<std::uint8_t>(ModeRefusal::kNoPrediction));
  EXPECT_EQ(answers[1].data[5], 0);
  StartCommand start = true_start(0);
  start.q_sensor_target[0] = 3;
  link.send(test::offer_start(start, 1));
  answers = link.answers();
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[1].is(1, 8));
  EXPECT_EQ(answers[1].data[4], 0);
  EXPECT_EQ(answers[1].data[5], static_cast<std::uint8_t>(StartRefusal::kNotUnit));
}

TEST(CommandDispatcher, ARefusedCommandSaysWhyAndChangesNothing) {
  VERIFIES("LASSO-LNK-013~2 LASSO-LNK-018~2 LASSO-LNK-019~2");
  Link link;
  link.send(test::set_mode(99));
  std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(answers[0].is(1, 2));
  EXPECT_EQ(answers[0].data[4], static_cast<std::uint8_t>(PacketFault::kBadArgument));
  link.send(test::ping(3));
  link.send(test::ping(3));
  answers = link.answers();
  ASSERT_EQ(answers.size(), 4u);
  EXPECT_EQ(answers[3].data[4], static_cast<std::uint8_t>(PacketFault::kRepeated));
  const Stream nothing = {1, 2, 3};
  EXPECT_TRUE(link.component().receive_packet(view(nothing), 0));
  answers = link.answers();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].data, (Stream{1, 2, 0, 0, static_cast<std::uint8_t>(PacketFault::kTruncated)})) << "what is there of it";
}

TEST(CommandDispatcher, CountersAreToldWhenTheyChange) {
  VERIFIES("LASSO-LNK-013~2");
  Link link;
  EXPECT_TRUE(link.run_link_frame().empty()) << "standby, and no command";
  link.send(test::ping(0));
  link.send(test::set_mode(99, 1));
  link.send({0xAA, 0xBB});
  link.answers();
  std::vector<Packet> told = link.run_link_frame();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].is(3, 25));
  EXPECT_EQ(Stream(told[0].data.begin(), told[0].data.begin() + 15), (Stream{0, 2, 0, 0, 0, 1, 0, 0, 0, 1, 11, 0, 0, 0, 2}));
  EXPECT_TRUE(link.run_link_frame().empty()) << "nothing new";
  link.send({0xCC});
  told = link.run_link_frame();
  ASSERT_EQ(told.size(), 1u) << "skipped bytes alone";
  EXPECT_EQ(told[0].data[14], 3);
}

TEST(CommandDispatcher, BytesThatBelongToNoCommandAreAnEvent) {
  VERIFIES("LASSO-LNK-015~2");
  Link link;
  link.run_frame();
  link.send({0xCC, 0xDD, 0xEE});
  const std::vector<Stream> events = events_of(link.run_frame());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0], (Stream{0, static_cast<std::uint8_t>(EventId::kBytesSkipped), 0, 0, 0, 3}));
}

TEST(CommandDispatcher, ALostScanIsToldWithItsSensor) {
  VERIFIES("LASSO-LCS-012~1");
  Link link;
  ASSERT_EQ(link.component().start_tracking(test::default_scene().pose_at(0), test::default_scene().rates, 0), Status::kOk);
  link.scene.sensor.lost = {4, 5};
  link.scene.sensor.refused = {7};
  std::vector<Stream> told;
  for (int frame = 0; frame < 12; ++frame) {
    for (const Packet& packet : link.run_link_frame()) told.push_back(packet.data);
  }
  ASSERT_EQ(told.size(), 3u) << "at the ends of frames 4, 5 and 7";
  const std::uint8_t scans[] = {5, 6, 8}, lost[] = {1, 2, 3};
  for (std::size_t i = 0; i < told.size(); ++i) {
    SensorTelemetry report;
    ByteReader in(view(told[i]));
    EXPECT_EQ(in.u16(), kSensorStructureId);
    codec_of(sensor_report_rows::kRows).read(in, report);
    EXPECT_EQ(report.sensor, 0);
    EXPECT_EQ(report.scans, scans[i]);
    EXPECT_EQ(report.lost, lost[i]);
    EXPECT_EQ(report.lost_other, i == 0 ? 1u : 2u);
    EXPECT_EQ(report.lost_refused, i == 2 ? 1u : 0u);
  }
}

TEST(CommandDispatcher, CommandsDoNotDisturbTheTrack) {
  VERIFIES("LASSO-LNK-011~2");
  Link quiet, busy;
  test::Generator random(9);
  std::uint16_t count = 0;
  for (Link* link : {&quiet, &busy})
    ASSERT_EQ(link->component().start_tracking(test::default_scene().pose_at(0), test::default_scene().rates, 0), Status::kOk);
  for (int frame = 0; frame < 12; ++frame) {
    Stream noise(random.below(200));
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random.bits());
    test::append(noise, test::ping(count++));
    busy.send(noise);
    const PoseTelemetry a = quiet.pose_of(quiet.run_frame()), b = busy.pose_of(busy.run_frame());
    ASSERT_EQ(a.valid, b.valid);
    for (int i = 0; i < 3; ++i) ASSERT_EQ(a.filter_p_sensor_target_m[i], b.filter_p_sensor_target_m[i]);
  }
}

// Each report by its bit, in the order of what happens.
TEST(CommandDispatcher, ReportsOfACommandAreThoseThatItAsksFor) {
  VERIFIES("LASSO-LNK-013~2");
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
