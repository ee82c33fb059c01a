#include "fsw/pose/bearing.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr TimeUs kPeriodUs = 200000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class BearingTest : public ::testing::Test {
 protected:
  BearingTest() {
    mission_.parameters = preset_parameters();
    mission_.parameters.sigma0_m = 0.02;
    mission_.parameters.sigma_k_per_m = 0;
    mission_.parameters.range_min_m = 1;
    mission_.parameters.range_max_m = 100;
    place(20, 1);
    scene_.rates = Twist{};
  }

  // A box of a tenth of the range, in a general attitude.
  void place(double range_m, std::uint64_t seed) {
    test::Generator random(seed);
    scene_.box.half = 0.08 * range_m * Vec3(1.3, 0.5, 0.8);
    scene_.box.center = 0.1 * range_m * Vec3(0.1, 0.05, -0.1);
    Vec3 turn;
    for (int i = 0; i < 3; ++i) turn[i] = random.normal();
    scene_.at_zero.q = exp_so3(turn);
    scene_.at_zero.p = Vec3(0, 0, range_m);
    for (int i = 0; i < 2; ++i) scene_.at_zero.p[i] = range_m * random.uniform(-0.08, 0.08);
    scene_.sigma_m = 0.02;
    mission_.radius_m = scene_.box.half.norm() + scene_.box.center.norm();
  }

  // A full-field rosette at k periods.
  RangeImage& scan(std::uint32_t k) {
    ScanPlan plan;
    plan.scan_id = k;
    plan.phase_turns = std::fmod(0.382 * k, 1);
    plan.half_x = plan.half_y = std::tan(mission_.parameters.fov_half_x_rad);
    test::Generator random(seed_ + k);
    scan_->scan_id = k;
    scan_->samples.clear();
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      EXPECT_TRUE(scan_->samples.push_back(test::cast_sample(scene_, plan, i, k * kPeriodUs + pattern_time_us(plan, i), random)));
    }
    return *scan_;
  }
  Bearing find(std::uint32_t k) { return finder_->find(mission_, scan(k), state_); }
  Bearing find(const RangeImage& image) { return finder_->find(mission_, image, state_); }

  // Turns rays that missed into returns.
  void add_strays(double share, RangeImage& image) {
    for (RangeSample& sample : image.samples) {
      if (strays_.uniform(0, 1) >= share) continue;
      sample.state = RayState::kHit;
      sample.range_m = static_cast<float>(strays_.uniform(1, 1.5 * scene_.at_zero.p.z()));
    }
  }
  static void add_wall(double z_m, RangeImage& image) {
    for (RangeSample& sample : image.samples) {
      if (sample.state == RayState::kHit) continue;
      sample.state = RayState::kHit;
      sample.range_m = static_cast<float>(z_m) / sample.direction[2];
    }
  }
  // The centroid that a scan of this target alone must give, from the samples themselves.
  static Vec3 mean_of(const RangeImage& image) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const RangeSample& sample : image.samples) {
      if (sample.state != RayState::kHit) continue;
      sum += static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
      ++count;
    }
    return sum / count;
  }
  void expect_refused(BearingReason reason, const RangeImage& image) {
    const BearingState before = state_;
    const Bearing bearing = find(image);
    EXPECT_EQ(bearing.reason, reason) << to_string(bearing.reason);
    EXPECT_TRUE(bearing.value.isZero(0)) << "nothing stale";
    EXPECT_TRUE(bearing.covariance.isZero(0));
    EXPECT_EQ(bearing.scans, 0u);
    EXPECT_EQ(state_.started, before.started);
    EXPECT_EQ(state_.t_us, before.t_us);
    EXPECT_EQ(state_.p_m, before.p_m);
    EXPECT_EQ(state_.scans, before.scans);
  }

  test::BoxScene scene_;
  Mission mission_;
  BearingState state_;
  std::uint64_t seed_ = 100;
  test::Generator strays_{3};
  std::unique_ptr<BearingFinder> finder_ = std::make_unique<BearingFinder>();
  std::unique_ptr<RangeImage> scan_ = std::make_unique<RangeImage>();
};

TEST_F(BearingTest, OneScanStatesTheCentroidOfItsReturns) {
  VERIFIES("LASSO-MOD-101~1");
  for (const double range_m : {1.5, 6.0, 30.0, 85.0}) {
    place(range_m, 11);
    mission_.radius_m *= 2;  // no return of the box is far from all others
    state_ = BearingState{};
    const RangeImage& image = scan(4);
    const Vec3 mean = mean_of(image);
    const Bearing bearing = find(image);
    ASSERT_TRUE(bearing.valid()) << to_string(bearing.reason);
    EXPECT_EQ(bearing.scan_id, 4u);
    EXPECT_EQ(bearing.scans, 1u);
    EXPECT_EQ(bearing.used, bearing.returns);
    EXPECT_NEAR(bearing.azimuth_rad(), std::atan2(mean.x(), mean.z()), 1e-6);
    EXPECT_NEAR(bearing.elevation_rad(), std::asin(-mean.y() / mean.norm()), 1e-6);
    EXPECT_NEAR(bearing.range_m(), mean.norm(), 1e-6 * mean.norm());
    EXPECT_EQ(bearing.closing_mps(), 0);
    EXPECT_NEAR(bearing.covariance(5, 5), 1, 1e-9) << "nothing is known of the velocity but bearing.rate_mps";
    EXPECT_GE(bearing.t_us, 4 * kPeriodUs);
    EXPECT_LE(bearing.t_us, 4 * kPeriodUs + 180000);
  }
}

// Right is positive azimuth and up is positive elevation, where the image's y points down.
TEST_F(BearingTest, AnglesCountRightAndUp) {
  VERIFIES("LASSO-MOD-101~1");
  scene_.at_zero.p = Vec3(2, -1.5, 20);
  const Bearing bearing = find(0);
  EXPECT_GT(bearing.azimuth_rad(), 0.05);
  EXPECT_GT(bearing.elevation_rad(), 0.04);
}

TEST_F(BearingTest, TheDerivativeIsThatOfTheBearing) {
  VERIFIES("LASSO-MOD-101~1");
  const Vec3 p(3.1, -2.2, 14.7);
  const Vec3 v(0.4, -0.3, -0.9);
  const Mat6 J = detail::bearing_jacobian(p, v);
  for (int i = 0; i < 6; ++i) {
    Vec6 step = Vec6::Zero();
    step[i] = 1e-5;
    const Vec6 after = detail::bearing_of(p + step.head<3>(), v + step.tail<3>());
    const Vec6 before = detail::bearing_of(p - step.head<3>(), v - step.tail<3>());
    EXPECT_LT(((after - before) / 2e-5 - J.col(i)).norm(), 1e-8) << i;
  }
  // The rates are the bearing's own change.
  const Vec6 now = detail::bearing_of(p, v);
  const Vec6 change = (detail::bearing_of(p + 1e-5 * v, v) - detail::bearing_of(p - 1e-5 * v, v)) / 2e-5;
  EXPECT_LT((change.head<3>() - now.tail<3>()).norm(), 1e-9);
}

struct Share {
  int cases = 0, inside = 0;
  double squared = 0;  // errors over sigma
};

// The figure: random attitudes, directions and speeds at each range, 10 scans with a LIDAR's noise.
TEST_F(BearingTest, ClosingRateIsKnownAfterTenScans) {
  VERIFIES("LASSO-MOD-103~1 LASSO-MOD-101~1");
  for (const double range_m : {1.5, 4.0, 12.0, 35.0, 90.0}) {
    Share share;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      place(range_m, seed);
      test::Generator random(seed + 1000);
      const double speed = random.uniform(0, 0.02) * range_m;
      scene_.rates.v_mps = Vec3(0, 0, -speed);
      for (int i = 0; i < 2; ++i) scene_.rates.v_mps[i] = 0.2 * speed * random.normal();
      state_ = BearingState{};
      seed_ = 1000 * seed;
      Bearing bearing;
      for (std::uint32_t k = 0; k < 10; ++k) bearing = find(k);
      ASSERT_TRUE(bearing.valid()) << to_string(bearing.reason);
      ASSERT_GE(bearing.used, 50);
      const double truth = -state_.p_m.normalized().dot(scene_.rates.v_mps);
      const double sigma = std::sqrt(bearing.covariance(5, 5));
      const double error = std::fabs(bearing.closing_mps() - truth);
      ++share.cases;
      share.inside += error <= std::max({0.02 * std::fabs(truth), 0.005, 2 * sigma}) ? 1 : 0;
      share.squared += error * error / (sigma * sigma);
    }
    EXPECT_GE(share.inside, 0.95 * share.cases) << range_m << " m";  // as many as 2 sigma hold of a normal error
    EXPECT_LT(share.squared / share.cases, 1.2) << "the covariance is honest at " << range_m << " m";
    EXPECT_GT(share.squared / share.cases, 0.05) << "and not timid at " << range_m << " m";
  }
}

// Without accelerations the filter is least squares: the same by the normal equations over all centroids at once.
TEST_F(BearingTest, ScansAreFusedAsLeastSquaresWould) {
  VERIFIES("LASSO-MOD-101~1");
  mission_.parameters.acceleration_mps2 = 0;
  scene_.rates.v_mps = Vec3(0.03, -0.02, -0.2);
  Mat6 information = Mat6::Zero();
  information.diagonal().tail<3>().setConstant(1 / std::pow(mission_.parameters.bearing_rate_mps, 2));
  Vec6 sum = Vec6::Zero();
  TimeUs first_us = 0;
  for (std::uint32_t k = 0; k < 6; ++k) {
    BearingState alone;
    const RangeImage& image = scan(k);
    ASSERT_TRUE(finder_->find(mission_, image, alone).valid());
    ASSERT_TRUE(find(image).valid());
    if (k == 0) first_us = alone.t_us;
    Eigen::Matrix<double, 3, 6> H = Eigen::Matrix<double, 3, 6>::Zero();
    H.leftCols<3>().setIdentity();
    H.rightCols<3>() = 1e-6 * static_cast<double>(alone.t_us - first_us) * Mat3::Identity();
    const Mat3 W = alone.covariance.topLeftCorner<3, 3>().inverse();
    information += H.transpose() * W * H;
    sum += H.transpose() * W * alone.p_m;
  }
  const Vec6 solution = information.ldlt().solve(sum);
  const double dt = 1e-6 * static_cast<double>(state_.t_us - first_us);
  EXPECT_LT((state_.v_mps - solution.tail<3>()).norm(), 1e-9);
  EXPECT_LT((state_.p_m - solution.head<3>() - dt * solution.tail<3>()).norm(), 1e-9);
  EXPECT_LT((state_.covariance.bottomRightCorner<3, 3>() - Mat6(information.inverse()).bottomRightCorner<3, 3>()).norm(), 1e-9);
  EXPECT_EQ(state_.scans, 6u);
}

TEST_F(BearingTest, AccelerationsLetTheVelocityForget) {
  VERIFIES("LASSO-MOD-101~1");
  for (std::uint32_t k = 0; k < 5; ++k) find(k);
  const BearingState calm = state_;
  state_ = BearingState{};
  mission_.parameters.acceleration_mps2 = 1;
  for (std::uint32_t k = 0; k < 5; ++k) find(k);
  EXPECT_GT(state_.covariance(5, 5), 2 * calm.covariance(5, 5));
}

TEST_F(BearingTest, BackgroundAndStraysHardlyMoveTheCentroid) {
  VERIFIES("LASSO-MOD-102~1");
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    place(20, seed);
    seed_ = 50 * seed;
    state_ = BearingState{};
    ASSERT_TRUE(find(0).valid());
    const BearingState clean = state_;
    RangeImage& image = scan(0);
    add_wall(70, image);
    add_strays(0.05, image);
    state_ = BearingState{};
    const Bearing bearing = find(image);
    ASSERT_TRUE(bearing.valid()) << to_string(bearing.reason);
    EXPECT_EQ(bearing.returns, 1024);
    EXPECT_LT(bearing.used, 1.1 * 1024 * 0.25);
    EXPECT_LT((state_.p_m - clean.p_m).norm(), 0.05 * mission_.radius_m) << seed;
    EXPECT_GT((mean_of(image) - clean.p_m).norm(), 5 * mission_.radius_m) << "what all returns together would say";
  }
}

TEST_F(BearingTest, AScanWithoutATargetSaysWhy) {
  VERIFIES("LASSO-MOD-104~1");
  RangeImage& image = scan(0);
  for (RangeSample& sample : image.samples) sample.state = RayState::kMiss;
  expect_refused(BearingReason::kNothingSeen, image);
  RangeImage& wall = scan(1);
  for (RangeSample& sample : wall.samples) sample.state = RayState::kMiss;
  add_wall(40, wall);
  expect_refused(BearingReason::kOnlyBackground, wall);
  RangeImage& empty = scan(2);
  empty.samples.clear();
  expect_refused(BearingReason::kNoScan, empty);
}

TEST_F(BearingTest, TooFewReturnsAreNoBearing) {
  VERIFIES("LASSO-MOD-104~1");
  mission_.parameters.bearing_returns_min = 40;
  const auto leave = [](int count, RangeImage& image) -> RangeImage& {
    for (RangeSample& sample : image.samples) {
      if (sample.state == RayState::kHit && count-- <= 0) sample.state = RayState::kMiss;
    }
    return image;
  };
  expect_refused(BearingReason::kTooFewReturns, leave(39, scan(0)));
  RangeImage& image = leave(39, scan(1));
  int strays = 10;  // enough returns, but not of one target
  for (RangeSample& sample : image.samples) {
    if (sample.state == RayState::kHit || strays-- <= 0) continue;
    sample.state = RayState::kHit;
    sample.range_m = 95;
  }
  expect_refused(BearingReason::kTooFewReturns, image);
  EXPECT_TRUE(find(leave(40, scan(2))).valid());
}

// What no ray of this sensor can have measured does not count; where nothing else is left, its kind is the reason.
TEST_F(BearingTest, ReturnsThatCannotBeAreNotBelieved) {
  VERIFIES("LASSO-MOD-104~1 LASSO-MOD-102~1");
  ASSERT_TRUE(find(0).valid());
  using Spoil = void (*)(RangeSample&);
  const struct {
    BearingReason reason;
    Spoil spoil;
  } cases[] = {
      {BearingReason::kNotFinite, [](RangeSample& s) { s.range_m = static_cast<float>(kNan); }},
      {BearingReason::kNotFinite, [](RangeSample& s) { s.direction[1] = static_cast<float>(kNan); }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[2] = -s.direction[2]; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[0] = 0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[0] = -0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[1] = 0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[1] = -0.3f; }},
      {BearingReason::kOutsideRange, [](RangeSample& s) { s.range_m = 0.99f; }},
      {BearingReason::kOutsideRange, [](RangeSample& s) { s.range_m = 100.1f; }},
  };
  std::uint32_t k = 1;
  for (const auto& c : cases) {
    RangeImage& all = scan(k++);
    for (RangeSample& sample : all.samples) {
      if (sample.state == RayState::kHit) c.spoil(sample);
    }
    expect_refused(c.reason, all);
    RangeImage& half = scan(k++);  // the other half is enough
    int index = 0;
    for (RangeSample& sample : half.samples) {
      if (sample.state == RayState::kHit && index++ % 2 == 0) c.spoil(sample);
    }
    const Bearing bearing = find(half);
    EXPECT_TRUE(bearing.valid()) << to_string(bearing.reason);
    EXPECT_EQ(bearing.credible, bearing.returns / 2);
  }
}

TEST_F(BearingTest, AllReturnsAtOnePointAreNoTarget) {
  VERIFIES("LASSO-MOD-104~1");
  RangeImage& image = scan(0);
  for (RangeSample& sample : image.samples) {
    sample.state = RayState::kHit;
    sample.direction[0] = 0.1f;
    sample.direction[1] = -0.05f;
    sample.direction[2] = 0.99373f;
    sample.range_m = 20;
  }
  expect_refused(BearingReason::kOneDirection, image);
  for (const int axis : {0, 1}) {  // spread in either direction is spread, on either side
    for (const float step : {1e-4f, -1e-4f}) {
      RangeImage& line = scan(axis == 0 ? 1 : 2);
      int index = 0;
      for (RangeSample& sample : line.samples) {
        sample.state = RayState::kHit;
        sample.direction[0] = 0.05f;
        sample.direction[1] = 0.05f;
        sample.direction[2] = 0.9975f;
        sample.direction[axis] += step * static_cast<float>(++index % 100);
        sample.range_m = 20;
      }
      state_ = BearingState{};
      EXPECT_TRUE(find(line).valid());
    }
  }
}

TEST_F(BearingTest, TimeThatGoesBackIsRefused) {
  VERIFIES("LASSO-MOD-104~1");
  ASSERT_TRUE(find(5).valid());
  expect_refused(BearingReason::kSameScan, scan(5));
  expect_refused(BearingReason::kOutOfOrder, scan(4));
  RangeImage& swapped = scan(6);
  std::swap(swapped.samples[10].t_us, swapped.samples[11].t_us);
  expect_refused(BearingReason::kOutOfOrder, swapped);
  EXPECT_TRUE(find(6).valid());
  // A later scan whose returns are earlier than those of the scan before.
  RangeImage& overlapping = scan(7);
  for (RangeSample& sample : overlapping.samples) sample.t_us = 6 * kPeriodUs;
  overlapping.samples[overlapping.samples.size() - 1].t_us = 7 * kPeriodUs + 90000;
  expect_refused(BearingReason::kOutOfOrder, overlapping);
}

TEST_F(BearingTest, AJumpIsBelievedTheThirdTime) {
  VERIFIES("LASSO-MOD-104~1");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  scene_.at_zero.p.z() += 25;
  expect_refused(BearingReason::kJump, scan(5));
  expect_refused(BearingReason::kJump, scan(6));
  const Bearing bearing = find(7);
  EXPECT_TRUE(bearing.valid());
  EXPECT_EQ(bearing.scans, 1u);
  EXPECT_GT(bearing.range_m(), 40);
  EXPECT_EQ(state_.jumps, 0u);
}

TEST_F(BearingTest, AJumpThatGoesAwayIsForgotten) {
  VERIFIES("LASSO-MOD-104~1");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  const double z = scene_.at_zero.p.z();
  for (std::uint32_t k = 5; k < 9; k += 2) {
    scene_.at_zero.p.z() = z + 25;
    EXPECT_EQ(find(k).reason, BearingReason::kJump);
    scene_.at_zero.p.z() = z;
    EXPECT_TRUE(find(k + 1).valid());
  }
  EXPECT_EQ(state_.scans, 7u);
}

// The estimate would lie behind the sensor: it is not joined, though its error is within the gate.
TEST_F(BearingTest, NoTargetIsBehindTheSensor) {
  VERIFIES("LASSO-MOD-104~1");
  place(1.3, 2);
  ASSERT_TRUE(find(0).valid());
  state_.p_m = Vec3(0, 0, -0.3);
  state_.v_mps.setZero();
  state_.covariance = 0.01 * Mat6::Identity();
  RangeImage& image = scan(1);
  mission_.parameters.sigma0_m = 5;  // nearly nothing is known from the scan
  expect_refused(BearingReason::kJump, image);
}

TEST_F(BearingTest, WhatIsOldStartsAnew) {
  VERIFIES("LASSO-MOD-101~1");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  EXPECT_EQ(find(4 + 24).scans, 6u);  // 4.8 s later
  EXPECT_EQ(find(4 + 24 + 27).scans, 1u);
}

TEST_F(BearingTest, TheSameScansGiveTheSameBits) {
  VERIFIES("LASSO-MOD-101~1");
  for (std::uint32_t k = 0; k < 4; ++k) find(k);
  const BearingState first = state_;
  state_ = BearingState{};
  finder_ = std::make_unique<BearingFinder>();
  for (std::uint32_t k = 0; k < 4; ++k) find(k);
  EXPECT_EQ(state_.p_m, first.p_m);
  EXPECT_EQ(state_.covariance, first.covariance);
}

TEST(BearingReason, HasAName) {
  VERIFIES("LASSO-MOD-104~1");
  EXPECT_EQ(std::string(to_string(BearingReason::kValid)), "valid");
  EXPECT_EQ(std::string(to_string(BearingReason::kJump)), "jump");
  EXPECT_EQ(std::string(to_string(static_cast<BearingReason>(99))), "unknown");
}

}  // namespace
}  // namespace lasso
