#include "mdat/recording/ros_messages.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/mcap/cdr.hpp"
#include "mdat/mcap/message_value.hpp"
#include "mdat/recording/ros_schemas.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::ros {
namespace {

using mcap::CdrReader;

Mat6 random_covariance(sim::Random& random) {
  Mat6 factor;
  for (int i = 0; i < 36; ++i) factor(i / 6, i % 6) = random.gaussian() * (i / 6 + 1);
  return factor * factor.transpose();
}

Pose random_pose(sim::Random& random) {
  Pose pose;
  const double x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
  pose.q = exp_so3(Vec3(x, y, z));
  for (int i = 0; i < 3; ++i) pose.p[i] = random.gaussian();
  return pose;
}

void read_header(CdrReader& in, std::int32_t seconds, std::uint32_t nanoseconds, const std::string& frame) {
  EXPECT_EQ(in.get<std::int32_t>(), seconds);
  EXPECT_EQ(in.get<std::uint32_t>(), nanoseconds);
  EXPECT_EQ(in.text(), frame);
}

// What ROS means: an error of the place along x, y, z, then a turn about x, y, z, all in the header's axes. Written out term by term.
TEST(RosMessages, CovariancesHaveTheTranslationFirst) {
  VERIFIES("LASSO-REC-004~1");
  sim::Random random(3);
  const Mat6 covariance = random_covariance(random);
  const Pose pose = random_pose(random);
  const std::string bytes = pose_with_covariance_bytes({1'500'000, "sensor"}, pose, covariance);
  CdrReader in(bytes);
  read_header(in, 1, 500'000'000, "sensor");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(in.get<double>(), pose.p[i]);
  for (const double value : {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()}) EXPECT_EQ(in.get<double>(), value);
  const int telemetry_row[] = {3, 4, 5, 0, 1, 2};  // of ROS's x, y, z, about x, about y, about z
  for (const int row : telemetry_row) {
    for (const int column : telemetry_row) EXPECT_EQ(in.get<double>(), covariance(row, column));
  }
  EXPECT_TRUE(in.ok());
}

// Rates of a frame in its own axes: the finite difference of where its points go, seen from the frame itself.
TEST(RosMessages, RatesAreInTheChildsAxes) {
  VERIFIES("LASSO-REC-004~1");
  sim::Random random(4);
  Odometry odometry;
  odometry.child = "target";
  odometry.pose = random_pose(random);
  for (int i = 0; i < 3; ++i) odometry.rates.omega_radps[i] = random.gaussian();
  for (int i = 0; i < 3; ++i) odometry.rates.v_mps[i] = random.gaussian();
  odometry.pose_sigmas << 0.1, 0.2, 0.3, 4, 5, 6;  // about x, y, z, then along
  odometry.rate_sigmas << 1, 2, 3, 4, 5, 6;
  const std::string bytes = odometry_bytes({0, "sensor"}, odometry);
  CdrReader in(bytes);
  read_header(in, 0, 0, "sensor");
  EXPECT_EQ(in.text(), "target");
  for (int i = 0; i < 7; ++i) (void)in.get<double>();
  const double variances[] = {16, 25, 36, 0.01, 0.04, 0.09};
  for (int i = 0; i < 36; ++i) EXPECT_NEAR(in.get<double>(), i % 7 == 0 ? variances[i / 7] : 0, 1e-12) << i;
  constexpr double kDt = 1e-6;
  const Pose moved = inverse(odometry.pose) * propagate(odometry.pose, odometry.rates, kDt);  // T_child_later
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), moved.p[i] / kDt, 1e-5);
  const Vec3 turn = log_so3(moved.q);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), turn[i] / kDt, 1e-5);
  const Mat3 R = to_matrix(odometry.pose.q);
  const Mat3 linear = R.transpose() * Vec3(16, 25, 36).asDiagonal() * R;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), linear(0, i), 1e-12);
}

// Read by the definitions that recordings hold.
TEST(RosMessages, ASceneHasItsSurfacesThenItsLines) {
  VERIFIES("LASSO-REC-001~1");
  const std::vector<Vec3> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  const std::vector<Path> paths = {{"pattern", "sensor", {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)}, true, Vec3(0.1, 0.2, 0.3)},
                                   {"edges", "sensor", {Vec3(1, 2, 3), Vec3(4, 5, 6)}, false, Vec3::Ones()}};
  const std::string bytes = scene_bytes(3'000'000, {{"target", "target_true", &corners, &triangles, Vec3::Ones(), 1}}, paths);
  const RosSchema schema = scene_update();
  const mcap::MessageValue scene = mcap::value_of(mcap::parse_definition(schema.name, schema.text), bytes);
  ASSERT_EQ(scene.at("entities").size(), 3U);
  EXPECT_EQ(scene.at("entities")[0].at("triangles")[0].at("points").size(), 3U);
  EXPECT_TRUE(scene.at("entities")[0].at("lines").empty());
  const mcap::MessageValue& pattern = scene.at("entities")[1];
  EXPECT_EQ(pattern.at("id"), "pattern");
  EXPECT_EQ(pattern.at("frame_id"), "sensor");
  EXPECT_TRUE(pattern.at("triangles").empty());
  EXPECT_EQ(pattern.at("lines")[0].at("type"), 0);  // a strip
  EXPECT_EQ(pattern.at("lines")[0].at("points")[2].at("y"), 8);
  EXPECT_EQ(pattern.at("lines")[0].at("color").at("g"), 0.2);
  EXPECT_EQ(scene.at("entities")[2].at("lines")[0].at("type"), 2);  // pairs
}

TEST(RosMessages, AnArrayOfPosesKeepsTheirOrder) {
  VERIFIES("LASSO-REC-001~1");
  sim::Random random(8);
  const std::vector<Pose> poses = {random_pose(random), random_pose(random)};
  const RosSchema schema = pose_array();
  const mcap::MessageValue array = mcap::value_of(mcap::parse_definition(schema.name, schema.text), pose_array_bytes({1, "sensor"}, poses));
  ASSERT_EQ(array.at("poses").size(), 2U);
  EXPECT_EQ(array.at("poses")[1].at("position").at("z"), poses[1].p.z());
  EXPECT_EQ(array.at("poses")[0].at("orientation").at("w"), poses[0].q.w());
}

TEST(RosMessages, APictureIsTheFileItself) {
  VERIFIES("LASSO-REC-045~1");
  const std::string png("\x89PNG\r\n\x1a\n\0more", 13), bytes = png_bytes({2'000'000, "camera/left"}, png);
  CdrReader in(bytes);
  read_header(in, 2, 0, "camera/left");
  EXPECT_EQ(in.text(), "png");
  EXPECT_EQ(in.blob(), png);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.left(), 0U);
}

// Where the projection of each camera puts a point of the left one's frame: there lies its picture, by the pinhole's own triangles.
TEST(RosMessages, BothCamerasProjectFromTheLeftOnesFrame) {
  VERIFIES("LASSO-REC-045~1");
  CameraModel camera{640, 480, 700, 710, 321, 242, {0.1, -0.2, 0.003, 0.004, 0.05}, 0};
  const Vec3 point_m(0.4, -0.3, 2.5);
  const RosSchema schema = camera_info();
  for (const double shift_m : {0.0, 0.25}) {
    camera.shift_m = shift_m;
    const mcap::MessageValue info =
        mcap::value_of(mcap::parse_definition(schema.name, schema.text), camera_info_bytes({1, "camera/left"}, camera));
    EXPECT_EQ(info.at("width"), 640);
    EXPECT_EQ(info.at("height"), 480);
    EXPECT_EQ(info.at("distortion_model"), "plumb_bob");
    EXPECT_EQ(info.at("d"), mcap::MessageValue(camera.distortion));
    EXPECT_EQ(info.at("k"), mcap::MessageValue({700.0, 0.0, 321.0, 0.0, 710.0, 242.0, 0.0, 0.0, 1.0}));
    EXPECT_EQ(info.at("r"), mcap::MessageValue({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}));
    const auto p = info.at("p").get<std::vector<double>>();
    ASSERT_EQ(p.size(), 12U);
    const auto row = [&](std::size_t i) {
      return p[4 * i] * point_m.x() + p[4 * i + 1] * point_m.y() + p[4 * i + 2] * point_m.z() + p[4 * i + 3];
    };
    EXPECT_NEAR(row(0) / row(2), 321 + 700 * (0.4 - shift_m) / 2.5, 1e-9);
    EXPECT_NEAR(row(1) / row(2), 242 - 710 * 0.3 / 2.5, 1e-9);
    EXPECT_EQ(info.at("roi").at("do_rectify"), false);
  }
}

TEST(RosMessages, TimesBeforeZeroHaveNanosecondsOfTheirOwn) {
  VERIFIES("LASSO-REC-001~1");
  const std::string bytes = pose_bytes({-1, "world"}, Pose{});
  CdrReader in(bytes);
  read_header(in, -1, 999'999'000, "world");
}

TEST(RosMessages, ATransformIsOfTheChildInItsParent) {
  VERIFIES("LASSO-REC-001~1");
  sim::Random random(6);
  const Pose pose = random_pose(random);
  const std::string bytes = tf_bytes(2'000'000, {{"world", "sensor", Pose{}}, {"sensor", "target", pose}});
  CdrReader in(bytes);
  EXPECT_EQ(in.get<std::uint32_t>(), 2U);
  read_header(in, 2, 0, "world");
  EXPECT_EQ(in.text(), "sensor");
  for (int i = 0; i < 7; ++i) EXPECT_EQ(in.get<double>(), i == 6 ? 1 : 0);
  read_header(in, 2, 0, "sensor");
  EXPECT_EQ(in.text(), "target");
  EXPECT_EQ(in.get<double>(), pose.p.x());
}

}  // namespace
}  // namespace lasso::mdat::ros
