// A recording of boxes, made without a run: each frame's poses, truth and scan have closed forms.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fsw/geometry/so3.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mission/parameters.hpp"
#include "fsw/pose/scan/result.hpp"
#include "mdat/mcap/writer.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/recording/ros_schemas.hpp"
#include "mdat/serve/answers.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::mdat::serve {

// A folder of the test, which goes with it.
class TestFolder {
 public:
  TestFolder() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("ut-serve-") + test->test_suite_name() + "-" + test->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
    path_ = std::filesystem::canonical(path_);
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct SmallRecording {
  static constexpr std::size_t kRays = 21;  // in each direction
  static constexpr TimeUs kPeriod_us = 200'000, kFirst_us = 1'100'000;

  std::size_t frames = 6;
  bool with_image = true, with_truth = true, own = true;
  Vec3 filter_shift_m = Vec3::Zero();  // of the filter from the truth
  std::size_t lost = 4;                // this frame's scan never came
  std::size_t wrong = 3;               // this one's pose says that it is valid, and is 100 mm off
  std::size_t refused = 2;             // this one has too few inliers
  std::size_t last_scan = 1000;        // later frames state the time of this one, and have no scan
  TimeUs scan_before_us = 0;           // all state this time, which is before the recording's

  static TimeUs time_us(std::size_t n) { return kFirst_us + static_cast<TimeUs>(n) * kPeriod_us; }
  static Twist rates() { return {Vec3(0.02, -0.05, 0.03), Vec3(0.01, -0.02, 0.03)}; }
  static Pose truth(std::size_t n) {
    const Pose first{exp_so3(Vec3(0.7, -0.4, 1.1)), Vec3(0.1, -0.05, 3)};
    return propagate(first, rates(), 0.2 * static_cast<double>(n));
  }
  // 3 mm and 4 mm off, turned by 0.2 deg about the boresight.
  static Pose estimate(std::size_t n) {
    Pose pose = truth(n);
    pose.p += Vec3(0.003, 0, -0.004);
    pose.q = exp_so3(Vec3(0, 0, 0.2 * kRadPerDeg)) * pose.q;
    return pose;
  }

  PoseTelemetry told(std::size_t n) const {
    PoseTelemetry pose;
    pose.scan_id = static_cast<std::uint32_t>(n);
    pose.t_measurement_us = scan_before_us > 0 ? scan_before_us : time_us(std::min(n, last_scan));
    pose.t_publication_us = time_us(n) + 300'000;
    pose.mode = 2;
    pose.valid = n == refused || n == lost ? 0 : 1;
    pose.reason = static_cast<std::uint8_t>(n == lost      ? PoseReason::kNoScan
                                            : n == refused ? PoseReason::kTooFewInliers
                                                           : PoseReason::kValid);
    pose.stop = static_cast<std::uint8_t>(n == lost ? StopReason::kNotRun : StopReason::kConverged);
    Pose registered = estimate(n);
    if (n == wrong) registered.p += Vec3(0, 0.1, 0);
    put(registered, pose.q_sensor_target, pose.p_sensor_target_m);
    Pose filtered = truth(n);
    filtered.p += filter_shift_m;
    put(filtered, pose.filter_q_sensor_target, pose.filter_p_sensor_target_m);
    for (int i = 0; i < 3; ++i) {
      pose.filter_omega_radps[i] = rates().omega_radps[i];
      pose.filter_v_mps[i] = rates().v_mps[i];
    }
    put_covariance(pose);
    for (std::size_t i = 0; i < kPoseSigmas; ++i) pose.filter_sigma_pose[i] = 0.001F;
    pose.rays = scan_before_us > 0 ? 0 : kRays * kRays;
    pose.returns = 300;
    pose.inliers = static_cast<std::uint16_t>(n == refused ? 7 : 290 + n);
    pose.iterations = 3;
    pose.rms_m = 0.002F;
    pose.normalized_residual = 1;
    pose.inlier_share = 0.97F;
    pose.agreement = 1;
    return pose;
  }

  // Sigmas of 1, 2, 3 mrad and 4, 5, 6 mm, with one correlation.
  static void put_covariance(PoseTelemetry& pose) {
    std::size_t at = 0;
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) pose.covariance[at++] = row == column ? 1e-6 * (row + 1) * (row + 1) : 0;
    }
    pose.covariance[1] = 0.5e-6;
  }

  static void put(const Pose& pose, double (&q)[4], double (&p)[3]) {
    for (int i = 0; i < 4; ++i) q[i] = pose.q.coeffs()[i];
    for (int i = 0; i < 3; ++i) p[i] = pose.p[i];
  }

  static std::string packet(const PoseTelemetry& pose) {
    std::uint8_t bytes[kMaxPosePacketBytes];
    PacketHeader header;
    const std::size_t size = encode_pose(pose, header, Bytes(bytes));
    return {reinterpret_cast<const char*>(bytes), size};
  }

  // Rays on a grid; each sees the boxes where they are at its own time.
  static std::vector<RangeSample> scan(std::size_t n) {
    std::vector<RangeSample> samples;
    for (std::size_t i = 0; i < kRays * kRays; ++i) {
      const auto x = static_cast<double>(i % kRays), y = static_cast<double>(i / kRays);
      const Vec3 u = Vec3(0.22 * (x / (kRays - 1) - 0.5) + 0.03, 0.22 * (y / (kRays - 1) - 0.5) - 0.015, 1).normalized();
      RangeSample sample;
      sample.t_us = time_us(n) + (static_cast<TimeUs>(i) - static_cast<TimeUs>(kRays * kRays / 2)) * 100;
      for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(u[k]);
      const Pose T_target_sensor = inverse(propagate(truth(n), rates(), to_seconds(sample.t_us - time_us(n))));
      const double range_m = test::cast_boxes(test::uneven_boxes(), T_target_sensor.p, rotate(T_target_sensor.q, u));
      sample.state = range_m > 0 ? RayState::kHit : RayState::kMiss;
      sample.range_m = range_m > 0 ? static_cast<float>(range_m) : 0;
      samples.push_back(sample);
    }
    return samples;
  }

  // As scan_cloud has it, with residuals of a thousandth of the ray's number.
  static ros::PointCloud cloud(std::size_t n) {
    ros::PointCloud cloud;
    using ros::FieldType;
    cloud.fields = {{"x", 0, FieldType::kFloat32},         {"y", 4, FieldType::kFloat32},
                    {"z", 8, FieldType::kFloat32},         {"ux", 12, FieldType::kFloat32},
                    {"uy", 16, FieldType::kFloat32},       {"uz", 20, FieldType::kFloat32},
                    {"range", 24, FieldType::kFloat32},    {"sigma_factor", 28, FieldType::kFloat32},
                    {"residual", 32, FieldType::kFloat32}, {"offset_us", 36, FieldType::kInt32},
                    {"state", 40, FieldType::kUint8},      {"part", 41, FieldType::kUint8},
                    {"sigma", 44, FieldType::kFloat32}};
    cloud.step = 48;
    float number = 0;
    for (const RangeSample& sample : scan(n)) {
      for (const float u : sample.direction) mcap::put(sample.range_m * u, cloud.data);
      for (const float u : sample.direction) mcap::put(u, cloud.data);
      for (const float value : {sample.range_m, sample.sigma_factor, 0.001F * number++}) mcap::put(value, cloud.data);
      mcap::put(static_cast<std::int32_t>(sample.t_us - time_us(n)), cloud.data);
      mcap::put(static_cast<std::uint32_t>(sample.state), cloud.data);
      mcap::put(0.002F, cloud.data);
    }
    return cloud;
  }

  static void append_box(const test::BoxModel& box, std::vector<Vec3>& points, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
      points.push_back(box.center + box.half.cwiseProduct(corner));
    }
    constexpr std::uint32_t kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& side : kSides) {
      triangles.push_back({first + side[0], first + side[1], first + side[2]});
      triangles.push_back({first + side[0], first + side[2], first + side[3]});
    }
  }

  std::filesystem::path write(const std::filesystem::path& file) const {
    mcap::Writer writer(file, "ros2", "test");
    const auto add = [&](const std::string& topic, const RosSchema& schema, mcap::Bulk bulk = mcap::Bulk::kSmall) {
      return writer.add_channel(topic, writer.add_schema(schema.name, "ros2msg", schema.text), "cdr", {}, bulk);
    };
    const std::uint16_t packets = add("/packets", ros::packet()), truths = add("/truth", ros::pose_stamped()),
                        events = add("/events", ros::log());
    const std::uint16_t tf = add("/tf", ros::tf_message());
    const std::uint16_t scans = add("/scan", ros::point_cloud(), mcap::Bulk::kLarge),
                        scene = add("/scene", ros::scene_update(), mcap::Bulk::kLarge);
    if (own)
      writer.add_metadata(kRecordingMetadata,
                          {{"mission", "mission/box.toml"}, {"scenario", "boxes"}, {"seed", "7"}, {"settings", "a.b=1\nc.d=2"}});
    write_scene(writer, scene);
    for (std::size_t n = 0; n < frames; ++n) {
      const auto ns = static_cast<std::uint64_t>(time_us(n)) * 1000, late_ns = ns + 300'000'000;
      if (own) writer.write(packets, late_ns, ros::packet_bytes({}, packet(told(n))));
      if (own && n == 2)
        writer.write(events, late_ns, ros::log_bytes(time_us(n), ros::LogLevel::kWarn, "scan_lost", "sensor 0, loss thin"));
      if (with_truth) writer.write(truths, ns, ros::pose_bytes({time_us(n), "sensor"}, truth(n)));
      writer.write(tf, ns, ros::tf_bytes(time_us(n), {{"world", "sensor", Pose{Quat::Identity(), Vec3(1, 2, 3)}}}));
      if (n != lost && n <= last_scan) writer.write(scans, ns, ros::point_cloud_bytes({time_us(n), "sensor"}, cloud(n)));
      if (n % 2 == 1) writer.add_metadata("chunk", {});  // ends the chunks
    }
    if (with_image) attach_image(writer);
    writer.close();
    return file;
  }

 private:
  static void write_scene(mcap::Writer& writer, std::uint16_t channel) {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const test::BoxModel& box : test::uneven_boxes()) append_box(box, points, triangles);
    writer.write(channel, static_cast<std::uint64_t>(time_us(0)) * 1000,
                 ros::scene_bytes(time_us(0), {{"target", "target", &points, &triangles, Vec3::Ones(), 1}}));
  }

  static void attach_image(mcap::Writer& writer) {
    test::TestImage image = test::make_image(preset_parameters(), test::make_box_tables(test::uneven_boxes()));
    writer.attach(kImageAttachment, "application/octet-stream", {reinterpret_cast<const char*>(image.data()), image.size}, 0);
  }
};

// A recording that is open, as the answers want it.
inline Shown shown_of(const std::filesystem::path& file) {
  return {"0123456789abcdef", file.filename().string(), std::make_shared<const Recording>(file)};
}

inline Target target_of(const std::string& text) { return parse_target(text).value(); }

// Of a binary answer, from byte `at` on.
template <class T>
T number_at_byte(const std::string& bytes, std::size_t at) {
  T value{};
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace lasso::mdat::serve
