#include "mdat/scene/motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

Eigen::Matrix4d matrix(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = pose.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = pose.p;
  return m;
}

double distance(const Pose& a, const Pose& b) { return (matrix(a) - matrix(b)).norm(); }

TEST(Still, StaysWhereItIs) {
  VERIFIES("LASSO-SCN-001~1");
  test::Generator random(1);
  const Pose pose = random_pose(random, 3);
  const Still still(pose);
  for (const TimeUs t_us : {TimeUs{-7}, TimeUs{0}, TimeUs{3'000'000'000'000}}) {
    EXPECT_EQ(distance(still.at(t_us).T_a_b, pose), 0);
    EXPECT_EQ(rate_error(still.at(t_us).rates, Twist{}), 0);
  }
}

// The pivot goes straight on, and the node turns about it as a screw does, by rotation matrices of Eigen.
TEST(ConstantRates, TurnsAboutThePivotThatMovesStraightOn) {
  VERIFIES("LASSO-SCN-001~1");
  test::Generator random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose T_parent_pivot = random_pose(random, 4);
    const Twist rates = random_rates(random, 0.2, 0.3);
    const Vec3 pivot_m = random_vector(random, 2);
    const ConstantRates motion({T_parent_pivot, rates, pivot_m});
    const TimeUs t_us = random_time_us(random, -30, 90);
    const MotionState now = motion.at(t_us);
    const double t_s = 1e-6 * static_cast<double>(t_us);
    ASSERT_NEAR((now.T_a_b * pivot_m - T_parent_pivot.p - t_s * rates.v_mps).norm(), 0, 1e-12);
    const Mat3 turned = Eigen::AngleAxisd(rates.omega_radps.norm() * t_s, rates.omega_radps.normalized()).toRotationMatrix();
    ASSERT_NEAR((now.T_a_b.q.toRotationMatrix() - turned * T_parent_pivot.q.toRotationMatrix()).norm(), 0, 1e-12);
    ASSERT_LT(rate_error(motion, t_us), 1e-9);
  }
}

TEST(Steps, TurnsAtTheBeginningOfEachPeriodAndRestsBetween) {
  VERIFIES("LASSO-SCN-001~1");
  test::Generator random(3);
  const Pose begin = random_pose(random, 4);
  const Vec3 axis(0.36, -0.48, 0.8);
  const Steps motion({begin, axis, 0.07, 100000});
  for (const std::int64_t step : {-3, -1, 0, 1, 17, 360}) {
    const Mat3 turn = Eigen::AngleAxisd(0.07 * static_cast<double>(step), axis).toRotationMatrix();
    for (const TimeUs t_us : {100000 * step, 100000 * step + 99999}) {
      EXPECT_EQ(motion.step_of(t_us), step);
      const MotionState now = motion.at(t_us);
      EXPECT_NEAR((now.T_a_b.q.toRotationMatrix() - begin.q.toRotationMatrix() * turn).norm(), 0, 1e-13) << step;
      EXPECT_EQ(now.T_a_b.p, begin.p);
      EXPECT_EQ(rate_error(now.rates, Twist{}), 0);
    }
  }
}

// Against products of 4 x 4 matrices, and differences of them.
TEST(Chain, IsTheProductOfItsMotionsWithTheLeverArmInItsRates) {
  VERIFIES("LASSO-SCN-002~1");
  test::Generator random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto draw = [&] {
      const Pose pose = random_pose(random, 3);
      const Twist rates = random_rates(random, 0.3, 0.2);
      return std::make_shared<ConstantRates>(ConstantRates::Setup{pose, rates, random_vector(random, 1)});
    };
    const auto outer = draw(), middle = draw(), inner = draw();
    const Chain chain(outer, std::make_shared<Chain>(middle, inner));
    const TimeUs t_us = random_time_us(random, -20, 20);
    const Eigen::Matrix4d product = matrix(outer->at(t_us).T_a_b) * matrix(middle->at(t_us).T_a_b) * matrix(inner->at(t_us).T_a_b);
    ASSERT_NEAR((matrix(chain.at(t_us).T_a_b) - product).norm(), 0, 1e-12);
    ASSERT_LT(rate_error(chain, t_us), 1e-8);
  }
  EXPECT_THROW(Chain(nullptr, std::make_shared<Still>(Pose{})), std::invalid_argument);
  EXPECT_THROW(Chain(std::make_shared<Still>(Pose{}), nullptr), std::invalid_argument);
}

TEST(MotionState, TheInverseIsTheParentSeenFromTheNode) {
  VERIFIES("LASSO-SCN-002~1");
  test::Generator random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose = random_pose(random, 3);
    const Twist rates = random_rates(random, 0.3, 0.2);
    const ConstantRates motion({pose, rates, random_vector(random, 1)});
    const TimeUs t_us = random_time_us(random, -20, 20);
    const MotionState back = inverse(motion.at(t_us));
    ASSERT_NEAR((matrix(back.T_a_b) - matrix(motion.at(t_us).T_a_b).inverse()).norm(), 0, 1e-12);
    const Twist expected = difference_rates([&](TimeUs t) { return inverse(motion.at(t).T_a_b); }, t_us);
    ASSERT_LT(rate_error(back.rates, expected), 1e-8);
  }
}

TEST(Motion, AllThatIsWrongWithOneIsSaidAtOnce) {
  VERIFIES("LASSO-SCN-003~1");
  const Pose twice{Quat(2, 0, 0, 0), Vec3::Zero()};
  const std::string pose = "scene: pose: is not a pose: expected finite numbers and a quaternion of unit length";
  EXPECT_EQ(problems_of([&] { Still{twice}; }), pose);
  EXPECT_EQ(problems_of([&] {
              ConstantRates({twice, {Vec3(kNan, 0, 0), Vec3(0, kNan, 0)}, Vec3(0, 0, kNan)});
            }),
            "scene: angular velocity: expected finite numbers\nscene: pivot: expected finite numbers\n" + pose +
                "\nscene: velocity: expected finite numbers");
  EXPECT_EQ(problems_of([&] {
              Steps({twice, Vec3(1, 1, 0), kNan, 0});
            }),
            "scene: axis: is not of unit length: divide it by its length\nscene: period: 0 us: expected more than 0 us\n" + pose +
                "\nscene: step: nan: expected a finite angle");
  EXPECT_EQ(problems_of([&] {
              Steps({Pose{}, Vec3::UnitX(), 0.1, -1}, {"flight.toml", 12, 3});
            }),
            "flight.toml:12:3: period: -1 us: expected more than 0 us");
}

// A motion that keeps the parent's axes before another one: the chain of both.
TEST(Sum, IsTheChainOfAWayAndAMotion) {
  VERIFIES("LASSO-SCN-002~1");
  test::Generator random(21);
  const Vec3 velocity_mps = random_vector(random, 0.3);
  const auto way =
      std::make_shared<ConstantRates>(ConstantRates::Setup{{Quat::Identity(), Vec3(1, -2, 3)}, {Vec3::Zero(), velocity_mps}, Vec3::Zero()});
  const auto turn = std::make_shared<ConstantRates>(
      ConstantRates::Setup{random_pose(random, 2), random_rates(random, 0.2, 0.1), random_vector(random, 1)});
  const Sum sum(way, turn);
  const Chain chain(way, turn);
  for (int i = 0; i < 20; ++i) {
    const TimeUs t_us = random_time_us(random, -30, 90);
    ASSERT_LT(distance(sum.at(t_us).T_a_b, chain.at(t_us).T_a_b), 1e-12);
    ASSERT_LT(rate_error(sum.at(t_us).rates, chain.at(t_us).rates), 1e-12);
    ASSERT_LT(rate_error(sum, t_us), 1e-9);
  }
  EXPECT_THROW(Sum(nullptr, turn), std::invalid_argument);
  EXPECT_THROW(Sum(way, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::mdat::scene
