#include "mdat/recording/link_recorder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "mdat/mcap/reader.hpp"
#include "ut/mdat/link/some_telemetry.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr TimeUs kFrame_us = 200'000;

// Frame n of a flight: measured in the middle of its scan, told a frame later.
PoseTelemetry flown_pose(int n) {
  PoseTelemetry pose;
  pose.scan_id = static_cast<std::uint32_t>(n);
  pose.t_measurement_us = n * kFrame_us + kFrame_us / 2;
  pose.t_publication_us = (n + 1) * kFrame_us;
  pose.valid = n % 2 == 0 ? 1 : 0;
  pose.p_sensor_target_m[2] = 3 + 0.01 * n;
  return pose;
}

struct Read {
  std::map<std::string, std::vector<std::uint64_t>> times_ns;  // of each topic
  std::uint64_t damage = 0;
};

Read read_back(const std::filesystem::path& file) {
  Read read;
  mcap::Reader reader(file);
  mcap::Visitor visitor;
  visitor.message = [&](const mcap::Channel& channel, const mcap::Message& message) {
    read.times_ns[channel.topic].push_back(message.log_ns);
  };
  read.damage = reader.read(visitor).size();
  return read;
}

class LinkRecorderTest : public ::testing::Test {
 protected:
  LinkRecorderTest() {
    folder_ = std::filesystem::temp_directory_path() / ("ut-link-recorder-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~LinkRecorderTest() override { std::filesystem::remove_all(folder_); }

  // `offset_us`: from the component's time to that of the headers.
  static void take(LinkRecorder& recorder, int n, TimeUs offset_us) {
    const PoseTelemetry pose = flown_pose(n);
    PacketHeader header;
    header.t_us = pose.t_publication_us + offset_us;
    header.time_status = offset_us != 0 ? kTimeStatusCorrelated : kTimeStatusFree;
    const TelemetryBytes packet = pose_packet(pose, header);
    recorder.take(decode_packet({packet.data(), packet.size()}, PacketType::kTelemetry));
  }
  std::filesystem::path folder_;
};

TEST_F(LinkRecorderTest, FramesHaveTheTimesOfTheComponentAndWhatALinkHas) {
  VERIFIES("LASSO-GND-163~1");
  for (const TimeUs offset_us : {TimeUs{0}, TimeUs{800'000'000'000'000}}) {
    const std::filesystem::path file = folder_ / ("seen" + std::to_string(offset_us) + ".mcap");
    LinkRecorder recorder({file, nullptr, link_recording_head(nullptr, "udp://:1", {}), nullptr});
    for (int n = 0; n < 6; ++n) take(recorder, n, offset_us);
    recorder.close();
    EXPECT_EQ(recorder.frames(), 6U);
    EXPECT_EQ(recorder.valid_frames(), 3U);
    EXPECT_EQ(recorder.last()->scan_id, 5U);
    const Read read = read_back(file);
    EXPECT_EQ(read.damage, 0U);
    std::vector<std::uint64_t> told, measured, valid;
    for (int n = 0; n < 6; ++n) {
      told.push_back(1000 * static_cast<std::uint64_t>(flown_pose(n).t_publication_us));
      measured.push_back(1000 * static_cast<std::uint64_t>(flown_pose(n).t_measurement_us));
      if (n % 2 == 0) valid.push_back(measured.back());
    }
    EXPECT_EQ(read.times_ns.at("/packets"), told);
    EXPECT_EQ(read.times_ns.at("/tf"), measured);
    EXPECT_EQ(read.times_ns.at("/pose"), valid);
    for (const char* topic : {"/scan", "/rays_missed", "/truth", "/sensor_scans", "/scene"})
      EXPECT_EQ(read.times_ns.count(topic), 0U) << topic;
  }
}

TEST_F(LinkRecorderTest, AClockThatBeginsAnewBeginsARecording) {
  VERIFIES("LASSO-GND-163~1");
  const std::filesystem::path file = folder_ / "seen.mcap";
  LinkRecorder recorder({file, nullptr, link_recording_head(nullptr, "udp://:1", {}), nullptr});
  for (const int n : {100, 101, 3, 4, 5}) take(recorder, n, 0);
  recorder.close();
  ASSERT_EQ(recorder.files(), (std::vector<std::filesystem::path>{file, folder_ / "seen-2.mcap"}));
  EXPECT_EQ(read_back(recorder.files()[0]).times_ns.at("/packets").size(), 2U);
  EXPECT_EQ(read_back(recorder.files()[1]).times_ns.at("/packets").size(), 3U);
  EXPECT_EQ(recorder.frames(), 5U);
}

// Before the first pose with spacecraft time nobody knows what the component's own time is.
TEST_F(LinkRecorderTest, WhatComesBeforeTheClockIsKnownIsKept) {
  VERIFIES("LASSO-GND-163~1");
  const std::filesystem::path file = folder_ / "seen.mcap";
  LinkRecorder recorder({file, nullptr, link_recording_head(nullptr, "udp://:1", {}), nullptr});
  constexpr TimeUs kOffset_us = 700'000'000'000'000;
  PacketHeader header;
  header.t_us = 3 * kFrame_us + kOffset_us;
  header.time_status = kTimeStatusCorrelated;
  header.service = 17;
  header.subservice = 2;
  TelemetryBytes pong(64);
  ByteWriter writer{Bytes(pong.data(), pong.size())};
  begin_packet(header, writer);
  pong.resize(finish_packet(writer, Bytes(pong.data(), pong.size())));
  ASSERT_FALSE(pong.empty());
  recorder.take(decode_packet({pong.data(), pong.size()}, PacketType::kTelemetry));
  take(recorder, 3, kOffset_us);
  recorder.close();
  EXPECT_EQ(recorder.files().size(), 1U);
  EXPECT_EQ(read_back(file).times_ns.at("/packets"), (std::vector<std::uint64_t>{600'000'000, 800'000'000}));
}

}  // namespace
}  // namespace lasso::mdat
