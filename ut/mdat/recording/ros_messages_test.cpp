#include "mdat/recording/ros_messages.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/mcap/cdr.hpp"
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
  odometry.pose_sigmas.setOnes();
  odometry.rate_sigmas << 1, 2, 3, 4, 5, 6;
  const std::string bytes = odometry_bytes({0, "sensor"}, odometry);
  CdrReader in(bytes);
  read_header(in, 0, 0, "sensor");
  EXPECT_EQ(in.text(), "target");
  for (int i = 0; i < 7 + 36; ++i) (void)in.get<double>();
  constexpr double kDt = 1e-6;
  const Pose moved = inverse(odometry.pose) * propagate(odometry.pose, odometry.rates, kDt);  // T_child_later
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), moved.p[i] / kDt, 1e-5);
  const Vec3 turn = log_so3(moved.q);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), turn[i] / kDt, 1e-5);
  const Mat3 R = to_matrix(odometry.pose.q);
  const Mat3 linear = R.transpose() * Vec3(16, 25, 36).asDiagonal() * R;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(in.get<double>(), linear(0, i), 1e-12);
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
