#include "fsw/pose/scan/point_maker.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "fsw/geometry/so3.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class PointMakerTest : public ::testing::Test {
 protected:
  PointMakerTest() {
    settings_.sigma0 = N::to<N::Sigma>(0.002);
    settings_.k = N::to<N::SigmaRate>(1e-4);
    settings_.angle = N::to<N::SigmaRate>(3e-4);
    settings_.surface = N::to<N::Sigma>(0.001);
    settings_.width = N::to<N::Kernel>(10);
    settings_.range_min = N::to<N::Length>(1);
    settings_.range_max = N::to<N::Length>(20);
    settings_.reference_us = 1'000'000;
  }

  void add(const Vec3& direction, double range_m, TimeUs t_us = 1'000'000) {
    RangeSample sample;
    for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(direction[i]);
    sample.range_m = static_cast<float>(range_m);
    sample.state = RayState::kHit;
    sample.t_us = t_us;
    ASSERT_TRUE(image_.samples.push_back(sample));
  }
  void make() { make_points(settings_, image_, false, *workspace_); }

  PointSettings<N> settings_{};
  RangeImage image_;
  std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
};

TEST_F(PointMakerTest, NoiseIsThatOfTheRange) {
  VERIFIES("LASSO-REG-003~2");
  const double range_m = 5;
  add(Vec3(0, 0, 1), range_m);
  make();
  const MatchPoint<N>& point = workspace_->points[0];
  const double grown_m = 1e-4 * range_m * range_m;
  EXPECT_NEAR(static_cast<double>(point.range_variance), 0.002 * 0.002 + grown_m * grown_m, 2e-10);
  EXPECT_NEAR(static_cast<double>(point.across_variance), 9e-8 * range_m * range_m, 2e-10);
  EXPECT_NEAR(static_cast<double>(point.reach), 10 * (0.002 + grown_m + 4 * 3e-4 * range_m + 0.001), 1e-5);
}

TEST_F(PointMakerTest, ReturnsFromBeyondTheSensorsRangesAreLeftOut) {
  VERIFIES("LASSO-REG-009~1");
  for (const double range_m : {0.9, 1.0, 20.0, 20.1}) add(Vec3(0, 0, 1), range_m);
  make();
  ASSERT_EQ(workspace_->points.size(), 2U);
  EXPECT_EQ(static_cast<double>(workspace_->points[0].p[2]), 1.0);
  EXPECT_EQ(static_cast<double>(workspace_->points[1].p[2]), 20.0);
}

// A place of the target, seen when it was somewhere else, is where it is at the reference time.
TEST_F(PointMakerTest, PointsAreWhereTheTargetHasThemAtTheReferenceTime) {
  VERIFIES("LASSO-REG-004~2");
  test::Generator random(91);
  const Vec3 origin(0.3, -0.2, 6);
  const Vec3 omega(0.05, -0.08, 0.04);
  const Vec3 velocity(0.05, 0.02, -0.1);
  settings_.moving = true;
  for (int i = 0; i < 3; ++i) {
    settings_.minus_half_rate[i] = N::to<N::Tangent>(-0.5 * omega[i]);
    settings_.origin[i] = N::to_length(origin[i]);
    settings_.velocity[i] = N::to<N::Length>(velocity[i]);
  }
  for (int i = 0; i < 50; ++i) {
    const Vec3 place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));  // from the target's origin, sensor axes
    const double tau_s = random.uniform(-0.1, 0.1);
    const Vec3 seen = origin + tau_s * velocity + rotate(exp_so3(tau_s * omega), place);
    image_.samples.clear();
    add(seen.normalized(), seen.norm(), 1'000'000 + static_cast<TimeUs>(tau_s * 1e6));
    make();
    const MatchPoint<N>& point = workspace_->points[0];
    const Vec3 found(static_cast<double>(point.p[0]), static_cast<double>(point.p[1]), static_cast<double>(point.p[2]));
    ASSERT_LT((found - (origin + place)).norm(), 3e-6);
  }
}

// By Cayley's map: a twelfth of the angle's cube is its error.
TEST_F(PointMakerTest, PointsOfATargetThatTurnsFastAreMovedAsFar) {
  VERIFIES("LASSO-REG-004~2");
  const Vec3 origin(0, 0, 6);
  const Vec3 place(1, 0, 0);
  settings_.moving = true;
  for (int i = 0; i < 3; ++i) settings_.origin[i] = N::to_length(origin[i]);
  for (const double rate : {6.0, -50.0}) {
    settings_.minus_half_rate[1] = N::to<N::Tangent>(-0.5 * rate);
    const double tau_s = 0.3 / rate;
    const Vec3 seen = origin + rotate(exp_so3(tau_s * Vec3(0, rate, 0)), place);
    image_.samples.clear();
    add(seen.normalized(), seen.norm(), 1'000'000 + static_cast<TimeUs>(tau_s * 1e6));
    make();
    const MatchPoint<N>& point = workspace_->points[0];
    const Vec3 found(static_cast<double>(point.p[0]), static_cast<double>(point.p[1]), static_cast<double>(point.p[2]));
    EXPECT_LT((found - (origin + place)).norm(), 0.3 * 0.3 * 0.3 / 12 + 1e-4) << rate;
  }
}

}  // namespace
}  // namespace lasso
