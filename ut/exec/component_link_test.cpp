// Commands by the link alone, and what telemetry answers.
#include "fsw/link/dictionary.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"

namespace lasso {
namespace {

using test::ComponentScene;
using test::Stream;
using test::view;

struct Packet {
  PacketHeader header;
  Stream data;
  bool is(std::uint8_t service, std::uint8_t subservice) const { return header.service == service && header.subservice == subservice; }
};

std::vector<Packet> packets_of(const Stream& stream) {
  std::vector<Packet> packets;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = packet_size({stream.data() + at, stream.size() - at});
    Packet packet;
    ConstBytes data;
    EXPECT_EQ(parse_packet({stream.data() + at, size}, packet.header, data), PacketFault::kNone);
    packet.data.assign(data.begin(), data.end());
    packets.push_back(packet);
    at += size;
  }
  return packets;
}

class Link {
 public:
  Link() : scene(test::box_parameters(test::default_scene())) { scene.begin(); }

  Component& component() { return *scene.component; }
  std::size_t send(const Stream& bytes) { return component().receive(view(bytes), component().next_slot_us()); }
  std::vector<Packet> answers() {
    Stream bytes(kTelemetryQueueBytes);
    bytes.resize(component().take_telemetry(Bytes(bytes.data(), bytes.size())));
    return packets_of(bytes);
  }
  // What it told but for poses.
  std::vector<Packet> run_link_frame() {
    std::vector<Packet> others;
    for (const Packet& packet : run_frame()) {
      if (!packet.is(3, 25) || packet.data[1] != kPoseStructureId) others.push_back(packet);
    }
    return others;
  }
  // The slots of one frame; what was told at its boundary.
  std::vector<Packet> run_frame() {
    do {
      component().run_slot(component().next_slot_us());
      component().run_estimation();
    } while (!component().next_slot_is_boundary());
    return answers();
  }
  PoseTelemetry pose_of(const std::vector<Packet>& packets) {
    PoseTelemetry pose;
    for (const Packet& packet : packets) {
      if (packet.is(3, 25) && packet.data[1] == kPoseStructureId) {
        ByteReader in(view(packet.data));
        in.u16();
        codec_of(pose_rows::kRows).read(in, pose);
      }
    }
    return pose;
  }
  ComponentScene scene;
};

StartCommand true_start(TimeUs t_us) {
  const test::BoxScene truth = test::default_scene();
  const Pose pose = truth.pose_at(t_us);
  StartCommand start;
  start.way = static_cast<std::uint8_t>(StartWay::kUplink);
  start.t_us = t_us;
  const double q[4] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()};
  for (std::size_t i = 0; i < 4; ++i) start.q_sensor_target[i] = q[i];
  for (int i = 0; i < 3; ++i) {
    start.p_sensor_target_m[i] = pose.p[i];
    start.omega_radps[i] = truth.rates.omega_radps[i];
    start.v_mps[i] = truth.rates.v_mps[i];
  }
  const std::size_t diagonal[] = {0, 6, 11, 15, 18, 20};
  for (const std::size_t term : diagonal) start.covariance[term] = term < 12 ? 1e-2F : 1e-3F;
  return start;
}

TEST(ComponentLink, PingIsAnswered) {
  VERIFIES("LASSO-LNK-013~1 LASSO-LNK-011~2");
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

TEST(ComponentLink, ReportsAreSentAsAskedFor) {
  VERIFIES("LASSO-LNK-013~1");
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
}

TEST(ComponentLink, AStartByUplinkIsTrackedFromTheNextBoundaryOn) {
  VERIFIES("LASSO-LNK-022~1 LASSO-LNK-011~2");
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
  EXPECT_EQ(pose.start_way, static_cast<std::uint8_t>(StartWay::kUplink));
  EXPECT_LT(link.scene.error(pose).norm(), 1e-2);
}

TEST(ComponentLink, ACommandedModeIsTakenAtTheNextBoundary) {
  VERIFIES("LASSO-LNK-022~1");
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

TEST(ComponentLink, WhatThePresentStateDoesNotAllowFailsWithItsReason) {
  VERIFIES("LASSO-LNK-013~1");
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

TEST(ComponentLink, ARefusedCommandSaysWhyAndChangesNothing) {
  VERIFIES("LASSO-LNK-013~1 LASSO-LNK-018~1 LASSO-LNK-019~1");
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

TEST(ComponentLink, CountersAreToldWhenTheyChange) {
  VERIFIES("LASSO-LNK-013~1");
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

TEST(ComponentLink, AFloodIsAnsweredByTheFrame) {
  VERIFIES("LASSO-LNK-011~2");
  Link link;
  Stream flood;
  for (std::uint16_t i = 0; i < 20; ++i) test::append(flood, test::ping(i));
  std::size_t taken = 0;
  for (int frame = 0; frame < 3; ++frame) {
    taken += link.send(Stream(flood.begin() + static_cast<std::ptrdiff_t>(taken), flood.end()));
    EXPECT_EQ(taken, std::min<std::size_t>(flood.size(), std::size_t{13} * kMaxCommandsPerFrame * static_cast<std::size_t>(frame + 1)));
    EXPECT_EQ(link.component().receive_packet(view(test::ping(100)), 0), frame == 2);
    link.run_frame();
  }
}

TEST(ComponentLink, ACommandBehindAFalseStartWaitsForASilentFrame) {
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

TEST(ComponentLink, CommandsDoNotDisturbTheTrack) {
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

}  // namespace
}  // namespace lasso
