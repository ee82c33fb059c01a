// Which events telemetry has, with what they say, and which of them are kept back.
#include <algorithm>

#include "ut/exec/component_operator.hpp"

namespace lasso {
namespace {

using test::events_of;
using test::Link;
using test::Packet;
using test::Stream;
using test::true_start;
using test::without_events;

TEST(ComponentEvents, BeginIsAnEvent) {
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

TEST(ComponentEvents, EachRefusalIsAnEventWithItsReason) {
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

TEST(ComponentEvents, EightRefusalsIn25FramesAreEventsAndTheRestIsCounted) {
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

TEST(ComponentEvents, EventsAreDisabledAndEnabledByCommand) {
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
TEST(ComponentEvents, EveryTransitionIsAnEventWithItsReason) {
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

TEST(ComponentEvents, LostScansAndSensorsAreEvents) {
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

TEST(ComponentEvents, LateSlotsLateEstimatesAndLostTelemetryAreEvents) {
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

}  // namespace
}  // namespace lasso
