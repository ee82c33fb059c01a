#include "mdat/serve/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal_sim/random.hpp"
#include "mdat/mcap/cdr.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

const Pose kPose{Quat(0.5, -0.5, 0.1, std::sqrt(1 - 0.51)), Vec3(1, -2, 3)};

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
}

TEST(RecordedMessages, PosesAndFramesAreReadBack) {
  VERIFIES("LASSO-WEB-008~1");
  const std::optional<StampedPose> pose = read_pose(ros::pose_bytes({2'500'001, "sensor"}, kPose));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->frame, "sensor");
  EXPECT_NEAR(pose->time_s, 2.500001, 1e-9);
  expect_same(pose->pose, kPose);
  const auto transforms = read_transforms(ros::tf_bytes(5, {{"world", "sensor", Pose{}}, {"sensor", "target", kPose}}));
  ASSERT_TRUE(transforms && transforms->size() == 2);
  EXPECT_EQ(transforms->at(1).child, "target");
  expect_same(transforms->at(1).T_parent_child, kPose);
}

TEST(RecordedMessages, EventsAndPacketsAreReadBack) {
  VERIFIES("LASSO-WEB-008~1");
  const std::optional<LogMessage> log = read_log(ros::log_bytes(1'000'000, ros::LogLevel::kWarn, "scan_lost", "sensor 0"));
  ASSERT_TRUE(log);
  EXPECT_EQ(log->level, 30);
  EXPECT_EQ(log->name, "scan_lost");
  EXPECT_EQ(log->text, "sensor 0");
  const std::string message = ros::packet_bytes({1, "x"}, "abc");
  const std::optional<ConstBytes> packet = read_packet(message);
  ASSERT_TRUE(packet && packet->size() == 3);
  EXPECT_EQ((*packet)[2], 'c');
}

TEST(RecordedMessages, CloudsAreReadByTheirFields) {
  VERIFIES("LASSO-WEB-008~1");
  const std::string message = ros::point_cloud_bytes({1, "sensor"}, SmallRecording::cloud(1));
  const std::optional<CloudView> cloud = read_cloud(message);
  ASSERT_TRUE(cloud);
  const std::vector<RangeSample> scan = SmallRecording::scan(1);
  ASSERT_EQ(cloud->size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_EQ(cloud->value(i, cloud->field("range")), scan[i].range_m);
    EXPECT_EQ(cloud->value(i, cloud->field("uz")), scan[i].direction[2]);
    EXPECT_EQ(cloud->value(i, cloud->field("state")), static_cast<float>(scan[i].state));
    EXPECT_EQ(cloud->value(i, cloud->field("offset_us")), static_cast<float>(scan[i].t_us - SmallRecording::time_us(1)));
  }
  EXPECT_TRUE(std::isnan(cloud->value(0, cloud->field("intensity"))));
  EXPECT_TRUE(std::isnan(cloud->value(scan.size(), cloud->field("range"))));
}

// Rows of two points (x as float32, then y as uint16 and two bytes), each row with bytes behind its points, as some drivers write them.
std::string cloud_of_rows(bool big_endian, std::uint32_t height, std::uint32_t row_step, const std::string& data) {
  mcap::CdrWriter out;
  out.put(std::int32_t{1}).put(std::uint32_t{0}).text("lidar").put(height).put(std::uint32_t{2}).put(std::uint32_t{2});
  out.text("x").put(std::uint32_t{0}).put(std::uint8_t{7}).put(std::uint32_t{1});
  out.text("y").put(std::uint32_t{4}).put(std::uint8_t{4}).put(std::uint32_t{1});
  out.put(static_cast<std::uint8_t>(big_endian)).put(std::uint32_t{8}).put(row_step);
  return out.blob(data).put(std::uint8_t{1}).bytes();
}

std::string point_bytes(float x, std::uint16_t y, bool big_endian) {
  std::string first, second;
  mcap::put(x, first);
  mcap::put(y, second);
  if (big_endian) std::reverse(first.begin(), first.end());
  if (big_endian) std::reverse(second.begin(), second.end());
  return first + second + "##";
}

TEST(RecordedMessages, CloudsOfOthersHaveRowsAndAnOrderOfBytes) {
  VERIFIES("LASSO-WEB-008~1");
  for (const bool big : {false, true}) {
    const std::string first = point_bytes(1.5F, 258, big) + point_bytes(-2, 3, big),
                      second = point_bytes(4, 5, big) + point_bytes(6, 7, big);
    const std::string message = cloud_of_rows(big, 2, 19, first + "pad" + second);
    const std::optional<CloudView> cloud = read_cloud(message);
    ASSERT_TRUE(cloud && cloud->size() == 4);
    const float x[] = {1.5F, -2, 4, 6}, y[] = {258, 3, 5, 7};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(cloud->value(i, cloud->field("x")), x[i]) << i;
      EXPECT_EQ(cloud->value(i, cloud->field("y")), y[i]) << i;
    }
    EXPECT_FALSE(read_cloud(cloud_of_rows(big, 2, 19, first + "pad" + second.substr(1)))) << "data that end within a point";
    EXPECT_FALSE(read_cloud(cloud_of_rows(big, 2, 15, first + second))) << "rows that lie in each other";
    EXPECT_FALSE(read_cloud(cloud_of_rows(big, 4'000'000'000, 16, first + second))) << "more rows than there are bytes";
    EXPECT_TRUE(read_cloud(cloud_of_rows(big, 1, 0, first))) << "a single row, whose length nothing says";
  }
}

TEST(RecordedMessages, SurfacesAreReadBack) {
  VERIFIES("LASSO-WEB-008~1");
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 2, 1}, {0, 1, 3}};
  const auto surface = read_surface(ros::scene_bytes(1, {{"a", "target_true", &points, &triangles, Vec3::Ones(), 1}}));
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->frame, "target_true");
  EXPECT_EQ(surface->points.at(3), (std::array<float, 3>{0, 0, 3}));
  EXPECT_EQ(surface->indices, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3}));
}

// Cut anywhere, or with any byte changed: no crash, and never a point outside of the data.
TEST(RecordedMessages, DamagedMessagesAreNone) {
  VERIFIES("LASSO-WEB-015~1");
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 2, 1}};
  ros::PointCloud cloud = SmallRecording::cloud(0);
  cloud.data.resize(5 * cloud.step);
  const std::string whole[] = {ros::pose_bytes({1, "s"}, kPose),
                               ros::tf_bytes(1, {{"a", "b", kPose}}),
                               ros::log_bytes(1, ros::LogLevel::kInfo, "n", "t"),
                               ros::point_cloud_bytes({1, "s"}, cloud),
                               ros::packet_bytes({1, "s"}, "abc"),
                               ros::scene_bytes(1, {{"a", "t", &points, &triangles, Vec3::Ones(), 1}})};
  const auto read_all = [](std::string_view bytes) {
    const std::optional<CloudView> view = read_cloud(bytes);
    for (std::size_t i = 0; view && i < view->size() && i < 10; ++i) {
      for (const CloudView::Field& field : view->fields) (void)view->value(i, &field);
    }
    const auto surface = read_surface(bytes);
    for (const std::uint32_t index : surface ? surface->indices : std::vector<std::uint32_t>()) EXPECT_LT(index, surface->points.size());
    return read_pose(bytes).has_value() + read_transforms(bytes).has_value() + read_log(bytes).has_value() + read_packet(bytes).has_value();
  };
  sim::Random random(3);
  for (const std::string& message : whole) {
    for (std::size_t size = 0; size < 4; ++size) EXPECT_EQ(read_all(message.substr(0, size)), 0);
    for (std::size_t size = 0; size < message.size(); ++size) (void)read_all(message.substr(0, size));
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = message;
      damaged[random.bits() % damaged.size()] = static_cast<char>(random.bits());
      (void)read_all(damaged);
    }
  }
}

}  // namespace
}  // namespace lasso::mdat::serve
