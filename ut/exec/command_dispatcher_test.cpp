// Commands by the link alone, and what telemetry answers.
#include <algorithm>

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
using test::without_events;

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

TEST(CommandDispatcher, BeginIsAnEvent) {
  VERIFIES("LASSO-LNK-015~2");
  Link link;
  const std::vector<Packet> packets = link.run_frame();
  const std::vector<Stream> events = events_of(packets);
  ASSERT_EQ(events.size(), 2u) << "and the start that the mission asks for";
  ASSERT_EQ(events[0].size(), 15u);
  EXPECT_EQ(Stream(events[0].begin(), events[0].begin() + 6), (Stream{0, 1, 0, 2, 0, 0})) << "version 0.2.0";
  const std::uint32_t crc = link.component().mission().image_crc;
  EXPECT_EQ(events[0][10], crc >> 24);
  EXPECT_EQ(events[0][13], crc & 0xFF);
}

TEST(CommandDispatcher, EachRefusalIsAnEventWithItsReason) {
  VERIFIES("LASSO-LNK-020~2 LASSO-LNK-015~2");
  Link link;
  link.run_frame();
  link.send(test::set_mode(99, 2));
  link.send(test::ping(3));
  link.send(test::ping(3));
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kReacquiring), 4));
  StartCommand start = true_start(0);
  start.q_sensor_target[0] = 3;
  link.send(test::offer_start(start, 5));
  const std::vector<Packet> packets = link.run_frame();
  const std::vector<Stream> events = events_of(packets);
  ASSERT_EQ(events.size(), 5u);
  EXPECT_EQ(events[0], (Stream{0, 4, 0x1B, 0xD1, 0xC0, 2, static_cast<std::uint8_t>(PacketFault::kBadArgument)}));
  EXPECT_EQ(events[1], (Stream{0, 4, 0x1B, 0xD1, 0xC0, 3, static_cast<std::uint8_t>(PacketFault::kRepeated)}));
  EXPECT_EQ(events[2], (Stream{0, 5, 8, 1, 0xC0, 4, static_cast<std::uint8_t>(ModeRefusal::kNotFromHere), 0, 0}));
  EXPECT_EQ(events[3],
            (Stream{0, 3, static_cast<std::uint8_t>(InitialPoseSource::kUplink), static_cast<std::uint8_t>(StartRefusal::kNotUnit)}));
  EXPECT_EQ(events[4], (Stream{0, 5, 8, 1, 0xC0, 5, 0, static_cast<std::uint8_t>(StartRefusal::kNotUnit), 0}));
  EXPECT_EQ(packets.back().header.subservice, 2);
}

TEST(CommandDispatcher, EightRefusalsIn25FramesAreEventsAndTheRestIsCounted) {
  VERIFIES("LASSO-LNK-020~2 LASSO-LNK-015~2");
  Link link;
  std::string refusals;  // events of each frame
  std::vector<Stream> suppressed;
  for (std::uint16_t frame = 0; frame < 26; ++frame) {
    link.send(test::set_mode(99, frame));
    char told = '0';
    for (const Stream& event : events_of(link.run_frame())) {
      if (event[1] == static_cast<std::uint8_t>(EventId::kCommandRefused)) ++told;
      if (event[1] == static_cast<std::uint8_t>(EventId::kEventsSuppressed)) suppressed.push_back(event);
    }
    refusals += told;
  }
  EXPECT_EQ(refusals, "11111111000000000000000001") << "a new window begins behind 25 frames";
  ASSERT_EQ(suppressed.size(), 1u);
  EXPECT_EQ(suppressed[0], (Stream{0, 15, 0, 4, 0, 0, 0, 17}));
}

TEST(CommandDispatcher, EventsAreDisabledAndEnabledByCommand) {
  VERIFIES("LASSO-LNK-015~2 LASSO-LNK-022~2");
  Link link;
  link.send(test::disable_event(1, 0));
  link.send(test::disable_event(4, 1));
  link.send(test::report_disabled(2));
  std::vector<Packet> answers = link.answers();
  ASSERT_EQ(answers.size(), 7u);
  EXPECT_TRUE(answers[5].is(5, 8));
  EXPECT_EQ(answers[5].data[0], 0x12);
  link.send(test::set_mode(99, 3));
  EXPECT_EQ(events_of(link.run_frame()).size(), 2u) << "begun was raised before it was disabled; the mode changed";
  link.send(test::enable_event(4, 4));
  link.send(test::set_mode(99, 5));
  EXPECT_EQ(events_of(link.run_frame()).size(), 1u);
  link.answers();
  link.send(test::disable_event(0, 6));
  answers = without_events(link.answers());
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[1].is(1, 8));
  EXPECT_EQ(answers[1].data, (Stream{0x1B, 0xD1, 0xC0, 6, 0, 0, static_cast<std::uint8_t>(ServiceRefusal::kNoSuchEvent)}));
}

// The story of modes is reported twice: in the pose packets, and as events.
TEST(CommandDispatcher, EveryTransitionIsAnEventWithItsReason) {
  VERIFIES("LASSO-MOD-172~2");
  Link link;
  std::vector<Stream> events, changes;
  std::uint16_t count = 0;
  for (int frame = 0; frame < 60; ++frame) {
    if (frame == 2) link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kBearing), count++));
    if (frame == 6) link.send(test::offer_start(true_start(link.component().next_slot_us()), count++));
    link.scene.sensor.hidden = frame >= 12;
    if (frame == 40) link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kStandby), count++));
    const std::vector<Packet> packets = link.run_frame();
    for (const Stream& event : events_of(packets)) {
      if (event[1] == 2) events.push_back({event[2], event[3], event[4]});
    }
    for (const Packet& packet : packets) {
      if (!packet.is(3, 25) || packet.data[1] != kPoseStructureId) continue;
      const PoseTelemetry pose = link.pose_of({packet});
      for (std::size_t i = 0; i < pose.changes; ++i) changes.push_back({pose.change_from[i], pose.change_event[i], pose.change_to[i]});
    }
  }
  EXPECT_GE(events.size(), 5u);
  EXPECT_EQ(events, changes);
  auto mode = static_cast<std::uint8_t>(TrackingMode::kStandby);
  for (const Stream& event : events) {
    EXPECT_EQ(event[0], mode) << "none is missing";
    mode = event[2];
    EXPECT_EQ(mode, static_cast<std::uint8_t>(next_mode(static_cast<TrackingMode>(event[0]), static_cast<ModeEvent>(event[1]))));
  }
  EXPECT_EQ(mode, static_cast<std::uint8_t>(TrackingMode::kStandby)) << "as it was commanded at the end";
}

TEST(CommandDispatcher, LostScansAndSensorsAreEvents) {
  VERIFIES("LASSO-LNK-015~2");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kBearing)));
  for (std::uint32_t scan = 0; scan < 8; ++scan) link.scene.sensor.refused.insert(scan);
  std::vector<Stream> events;
  for (int frame = 0; frame < 8; ++frame) {
    for (const Stream& event : events_of(link.run_frame())) {
      if (event[1] > 2) events.push_back(event);
    }
  }
  ASSERT_GE(events.size(), 4u);
  EXPECT_EQ(events[0], (Stream{0, 11, 0, 0, 0, 0, 0, 5}));
  EXPECT_EQ(events[1], (Stream{0, 11, 0, 0, 0, 0, 1, 5}));
  EXPECT_NE(std::find(events.begin(), events.end(), Stream({0, 9, 0})), events.end()) << "the sensor has failed";
  bool back = false;
  for (int frame = 0; frame < 80; ++frame) {
    for (const Stream& event : events_of(link.run_frame())) back = back || event == Stream({0, 10, 0});
  }
  EXPECT_TRUE(back) << "it has rested";
}

TEST(CommandDispatcher, LateSlotsLateEstimatesAndLostTelemetryAreEvents) {
  VERIFIES("LASSO-LNK-015~2");
  Link link;
  link.send(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kBearing)));
  std::vector<std::uint8_t> numbers;
  Component& component = link.component();
  for (int frame = 0; frame < 40; ++frame) {
    do {
      component.run_slot(component.next_slot_us() + (frame == 3 ? 60000 : 0));  // later than any slot is long
    } while (!component.next_slot_is_boundary());
    if (frame % 15 != 14) continue;
    for (const Stream& event : events_of(link.answers())) numbers.push_back(event[1]);
  }
  const auto told = [&](std::uint8_t number) { return std::find(numbers.begin(), numbers.end(), number) != numbers.end(); };
  EXPECT_TRUE(told(13)) << "a slot was late";
  EXPECT_TRUE(told(12)) << "nobody estimated";
  EXPECT_TRUE(told(7)) << "nobody took telemetry for 15 frames";
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
