// The numbers of docs/conventions.md, computed again: by the project's own functions where it has them, otherwise by Eigen or term by term.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "fsw/geometry/so3.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/run/case.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLastDigit = 1e-6;

// Tables of the page: the numbers in the cells behind the first one, by the first one's text.
std::map<std::string, std::vector<double>> page_rows() {
  std::map<std::string, std::vector<double>> rows;
  std::ifstream page(test::source_folder() / "docs/conventions.md");
  for (std::string line; std::getline(page, line);) {
    const std::size_t end = line.find(" | ");
    if (line.rfind("| ", 0) != 0 || end == std::string::npos) continue;
    std::string cells = line.substr(end);
    for (char& c : cells) c = c == '|' ? ' ' : c;
    std::istringstream words(cells);
    const std::vector<double> numbers{std::istream_iterator<double>(words), std::istream_iterator<double>()};
    if (!numbers.empty()) rows[line.substr(2, end - 2)] = numbers;
  }
  return rows;
}

template <class Vector>
void expect_row(const std::string& name, const Vector& expected) {
  const auto rows = page_rows();
  const auto row = rows.find(name);
  ASSERT_NE(row, rows.end()) << name;
  ASSERT_EQ(row->second.size(), static_cast<std::size_t>(expected.size())) << name;
  for (std::size_t i = 0; i < row->second.size(); ++i)
    EXPECT_NEAR(row->second[i], expected[static_cast<Eigen::Index>(i)], kLastDigit) << name << " " << i;
}

// The example: yaw, pitch and roll as words of Eigen; position; rates in sensor axes.
const Eigen::Quaterniond kTurn = Eigen::AngleAxisd(40 * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(-25 * kRadPerDeg, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(110 * kRadPerDeg, Eigen::Vector3d::UnitX());
const Eigen::Vector3d kPlace(0.3, -0.2, 4.0), kRate(0.01, -0.02, 0.03);

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

TEST(Conventions, ThePagesAttitudesAreOneAttitude) {
  VERIFIES("LASSO-GND-141~1");
  const Eigen::Matrix3d R = kTurn.toRotationMatrix();
  Eigen::Matrix<double, 9, 1> by_rows;
  for (int i = 0; i < 9; ++i) by_rows[i] = R(i / 3, i % 3);
  expect_row("R_sensor_target, by rows", by_rows);
  expect_row("quaternion x, y, z, w: here, ROS, TUM, `coeffs()`", kTurn.coeffs());
  expect_row("quaternion w, x, y, z: `m2q`, `beta_TS`, Eigen's constructor", Eigen::Vector4d(kTurn.w(), kTurn.x(), kTurn.y(), kTurn.z()));
  const Eigen::Quaterniond back(Eigen::Matrix3d(R.transpose()));
  const double sign = back.w() * kTurn.w() < 0 ? -1 : 1;
  expect_row("quaternion of a C-kernel, w, x, y, z", Eigen::Vector4d(sign * Eigen::Vector4d(back.w(), back.x(), back.y(), back.z())));
  const Eigen::AngleAxisd turn(kTurn);
  expect_row("rotation vector, rad", Eigen::Vector3d(turn.angle() * turn.axis()));
}

// Basilisk's matrix of an MRP (Schaub and Junkins): it takes coordinates of the reference to those of the body.
TEST(Conventions, TheMrpIsThatOfTheTargetRelativeToTheSensor) {
  VERIFIES("LASSO-GND-141~1");
  const Eigen::Vector3d sigma = kTurn.vec() / (1 + kTurn.w());
  expect_row("MRP `sigma_TS`", sigma);
  const double s2 = sigma.squaredNorm();
  const Eigen::Matrix3d tilde = cross_matrix(sigma);
  const Eigen::Matrix3d dcm_TS = Eigen::Matrix3d::Identity() + (8 * tilde * tilde - 4 * (1 - s2) * tilde) / ((1 + s2) * (1 + s2));
  EXPECT_TRUE(dcm_TS.isApprox(kTurn.toRotationMatrix().transpose(), 1e-12));
}

TEST(Conventions, ThisProjectsFunctionsAgree) {
  VERIFIES("LASSO-GND-141~1");
  const Pose pose{Quat(kTurn.w(), kTurn.x(), kTurn.y(), kTurn.z()), kPlace};
  EXPECT_TRUE(to_matrix(pose.q).isApprox(kTurn.toRotationMatrix(), 1e-12));
  const Vec3 yaw_pitch_roll = euler_zyx(to_matrix(pose.q));
  expect_row("`rpy` of ROS, rad", Vec3(yaw_pitch_roll.reverse()));
  expect_row("rotation vector, rad", log_so3(pose.q));
  expect_row("target's point (1, 2, 3) m, in the sensor's frame", pose * Vec3(1, 2, 3));
  expect_row("p_target_sensor: the sensor's place in the target's frame, m", inverse(pose).p);
}

// What a recording says, read back from its last numbers: linear, then angular rate in the target's axes, and 36 of covariance.
TEST(Conventions, RecordedRatesAreInTheTargetsAxes) {
  VERIFIES("LASSO-GND-141~1");
  ros::Odometry odometry;
  odometry.child = "target";
  odometry.pose = {Quat(kTurn.w(), kTurn.x(), kTurn.y(), kTurn.z()), kPlace};
  odometry.rates = {kRate, Vec3::Zero()};
  odometry.pose_sigmas.setOnes();
  odometry.rate_sigmas.setOnes();
  const std::string bytes = ros::odometry_bytes({0, "sensor"}, odometry);
  Vec3 angular;
  std::memcpy(angular.data(), bytes.data() + bytes.size() - (36 + 3) * sizeof(double), sizeof angular);
  expect_row("angular rate in the target's axes, rad/s: `twist.angular`", angular);
}

// Each of the 21 numbers of telemetry by itself: where the page says it is, among ROS's 36.
TEST(Conventions, CovariancesAreWhereThePageSays) {
  VERIFIES("LASSO-GND-141~1");
  int rows = 0;
  for (const auto& [name, places] : page_rows()) {
    if (name.find(" about ") == std::string::npos && name.find(" along ") == std::string::npos) continue;
    ASSERT_EQ(places.size(), 2U) << name;
    PoseTelemetry told{};
    told.covariance[static_cast<std::size_t>(places[0])] = 7;
    const std::vector<double> values = ros::ros_covariance(registration_covariance(told));
    EXPECT_EQ(values[static_cast<std::size_t>(places[1])], 7) << name;
    ++rows;
  }
  EXPECT_EQ(rows, 7);
}

}  // namespace
}  // namespace lasso::mdat
