#include <algorithm>
#include <cmath>
#include <string>

#include "ut/pose/bearing_fixture.hpp"
#include "ut/support/dense.hpp"

namespace lasso {
namespace {

using test::BearingTest;
using test::kPeriodUs;

TEST_F(BearingTest, OneScanStatesTheCentroidOfItsReturns) {
  VERIFIES("LASSO-MOD-101~3");
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
    const double expected_m2 = variance_of_depth(image, mean) / bearing.used + std::pow(mission_.radius_m / 32, 2);
    EXPECT_NEAR(bearing.covariance(2, 2), expected_m2, 1e-5 * expected_m2);
    EXPECT_NEAR(static_cast<double>(bearing.t_us), mean_time_of(image), 1);
  }
}

// Right is positive azimuth and up is positive elevation, where the image's y points down.
TEST_F(BearingTest, AnglesCountRightAndUp) {
  VERIFIES("LASSO-MOD-101~3");
  scene_.at_zero.p = Vec3(2, -1.5, 20);
  const Bearing bearing = find(0);
  EXPECT_GT(bearing.azimuth_rad(), 0.05);
  EXPECT_GT(bearing.elevation_rad(), 0.04);
}

TEST_F(BearingTest, TheDerivativeIsThatOfTheBearing) {
  VERIFIES("LASSO-MOD-101~3");
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

// The figure: random attitudes, directions and speeds at each range, 10 scans with a LIDAR's noise.
TEST_F(BearingTest, ClosingRateIsKnownAfterTenScans) {
  VERIFIES("LASSO-MOD-103~2 LASSO-MOD-101~3");
  constexpr int kTargets = 6;  // at each range
  int inside = 0, targets = 0;
  double squared = 0;  // errors over sigma
  for (const double range_m : {1.5, 4.0, 12.0, 35.0, 90.0}) {
    for (std::uint64_t seed = 0; seed < kTargets; ++seed) {
      const Bearing bearing = ten_scans(range_m, seed);
      ASSERT_TRUE(bearing.valid()) << to_string(bearing.reason);
      ASSERT_GE(bearing.used, 50);
      const double truth = -state_.p_m.normalized().dot(scene_.rates.v_mps);
      const double sigma = std::sqrt(bearing.covariance(5, 5));
      const double error = std::fabs(bearing.closing_mps() - truth);
      EXPECT_LT(error, 4 * sigma) << range_m << " m, seed " << seed;
      inside += error <= std::max({0.02 * std::fabs(truth), 0.005, 2 * sigma}) ? 1 : 0;
      squared += error * error / (sigma * sigma);
      ++targets;
    }
  }
  EXPECT_GE(inside, 0.95 * targets);  // as many as 2 sigma hold of a normal error
  EXPECT_LT(squared / targets, 1.2) << "the covariance is honest";
  EXPECT_GT(squared / targets, 0.05) << "and not timid";
}

// Of the last `size` values; the rates are the last three.
double nees_of_last(int size, const Bearing& bearing, const Vec6& error) {
  test::Dense covariance(size, size);
  test::DenseVector e(size);
  for (int i = 0; i < size; ++i) {
    e[i] = error[6 - size + i];
    for (int k = 0; k < size; ++k) covariance(i, k) = bearing.covariance(6 - size + i, 6 - size + k);
  }
  return e.dot(test::solution_of(covariance, e));
}

// Targets whose returns fill the ranges for which a bearing is asked. Of the rates the sum of the squared errors over their covariance is
// chi-squared with three degrees of freedom a target: between 54.2 and 137.2 in 99.8 of 100 cases for 30 targets. Of all six values it is
// less than that of chance, 244.4 in 99.9 of 100 cases: what is left out moves the centroid by less than could be.
TEST_F(BearingTest, AllValuesAreThoseOfTheTargetAfterTenScans) {
  VERIFIES("LASSO-MOD-101~3");
  double rates = 0, all = 0, nearest_m = 1e9, farthest_m = 0;
  for (const double range_m : {1.25, 4.0, 12.0, 35.0, 92.0}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE("at " + std::to_string(range_m) + " m, seed " + std::to_string(seed));
      const Bearing bearing = ten_scans(range_m, seed);
      ASSERT_TRUE(bearing.valid()) << to_string(bearing.reason);
      ASSERT_EQ(bearing.credible, bearing.returns);
      for (const RangeSample& sample : scan_->samples) {
        if (sample.state != RayState::kHit) continue;
        nearest_m = std::min(nearest_m, static_cast<double>(sample.range_m));
        farthest_m = std::max(farthest_m, static_cast<double>(sample.range_m));
      }
      const Vec6 error = bearing.value - truth_at(bearing.t_us);
      for (int i = 0; i < 6; ++i) EXPECT_LT(std::fabs(error[i]), 4 * std::sqrt(bearing.covariance(i, i))) << "value " << i;
      rates += nees_of_last(3, bearing, error);
      all += nees_of_last(6, bearing, error);
    }
  }
  EXPECT_GT(rates, 54.2);
  EXPECT_LT(rates, 137.2);
  EXPECT_LT(all, 244.4);
  EXPECT_GT(nearest_m, 1);
  EXPECT_LT(nearest_m, 1.1);
  EXPECT_GT(farthest_m, 95);
  EXPECT_LT(farthest_m, 100);
}

// Without accelerations the filter is least squares: the same by the normal equations over all centroids at once.
TEST_F(BearingTest, ScansAreFusedAsLeastSquaresWould) {
  VERIFIES("LASSO-MOD-101~3");
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
    const Mat3 W = test::inverse_of(alone.covariance.topLeftCorner<3, 3>());
    information += H.transpose() * W * H;
    sum += H.transpose() * W * alone.p_m;
  }
  const Vec6 solution = test::solution_of(information, sum);
  const double dt = 1e-6 * static_cast<double>(state_.t_us - first_us);
  EXPECT_LT((state_.v_mps - solution.tail<3>()).norm(), 1e-9);
  EXPECT_LT((state_.p_m - solution.head<3>() - dt * solution.tail<3>()).norm(), 1e-9);
  EXPECT_LT((state_.covariance.bottomRightCorner<3, 3>() - test::inverse_of(information).bottomRightCorner(3, 3)).norm(), 1e-9);
  EXPECT_EQ(state_.scans, 6u);
}

TEST_F(BearingTest, AccelerationsLetTheVelocityForget) {
  VERIFIES("LASSO-MOD-101~3");
  for (std::uint32_t k = 0; k < 5; ++k) find(k);
  const BearingState calm = state_;
  state_ = BearingState{};
  mission_.parameters.acceleration_mps2 = 1;
  for (std::uint32_t k = 0; k < 5; ++k) find(k);
  EXPECT_GT(state_.covariance(5, 5), 2 * calm.covariance(5, 5));
}

TEST_F(BearingTest, BackgroundAndStraysHardlyMoveTheCentroid) {
  VERIFIES("LASSO-MOD-102~2");
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

TEST_F(BearingTest, WhatIsOldStartsAnew) {
  VERIFIES("LASSO-MOD-101~3");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  EXPECT_EQ(find(4 + 24).scans, 6u);  // 4.8 s later
  EXPECT_EQ(find(4 + 24 + 27).scans, 1u);
}

TEST_F(BearingTest, TheSameScansGiveTheSameBits) {
  VERIFIES("LASSO-MOD-101~3");
  for (std::uint32_t k = 0; k < 4; ++k) find(k);
  const BearingState first = state_;
  state_ = BearingState{};
  finder_ = std::make_unique<BearingFinder>();
  for (std::uint32_t k = 0; k < 4; ++k) find(k);
  EXPECT_EQ(state_.p_m, first.p_m);
  EXPECT_EQ(state_.covariance, first.covariance);
}

}  // namespace
}  // namespace lasso
