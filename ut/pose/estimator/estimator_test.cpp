#include "fsw/pose/estimator/estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "fsw/geometry/symmetric6.hpp"
#include "ut/pose/estimator_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxScan;
using test::EstimatorTest;

TEST_F(EstimatorTest, NoiseFreeScanGivesTheExactPose) {
  VERIFIES("LASSO-REG-001~1");
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.2, 0.1, random_);
    const Registration r = estimate_from(0.01, 0.005);
    ASSERT_TRUE(r.valid()) << to_string(r.reason);
    EXPECT_EQ(r.stop, StopReason::kConverged);
    EXPECT_LT(error(r).tail<3>().norm(), 2e-5);
    EXPECT_LT(error(r).head<3>().norm(), 5e-5);
  }
}

struct Spread {
  double nees = 0, shift2 = 0, turn2 = 0;
};

TEST_F(EstimatorTest, CovarianceIsHonestAndSilhouettesAddInformation) {
  VERIFIES("LASSO-REG-002~1 LASSO-REG-003~2");
  scan_.sigma_m = 1e-3;
  Spread spread[2];
  constexpr int kScans = 150;
  for (int i = 0; i < kScans; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.2, 0.1, random_);
    const auto image = test::scan_box(scan_, random_);
    StartPoint start;
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.005, 0.003, random_);
    for (int silhouettes = 0; silhouettes < 2; ++silhouettes) {
      parameters().silhouettes = silhouettes;
      const Registration r = estimate(*image, start);
      ASSERT_TRUE(r.valid());
      Vec6 x;
      ASSERT_EQ(solve6(r.covariance, error(r), x), Status::kOk);
      spread[silhouettes].nees += error(r).dot(x) / kScans;
      spread[silhouettes].turn2 += error(r).head<3>().squaredNorm();
      spread[silhouettes].shift2 += error(r).tail<3>().squaredNorm();
    }
  }
  for (const Spread& s : spread) {
    EXPECT_GT(s.nees, 4.8);
    EXPECT_LT(s.nees, 7.5);
  }
  EXPECT_LT(spread[1].turn2, spread[0].turn2);
  EXPECT_LT(spread[1].shift2, spread[0].shift2);
}

// Twice the noise that the mission states is more than it tolerates: such poses are not valid, and their covariance is as honest.
TEST_F(EstimatorTest, CovarianceIsHonestWhereTheNoiseIsHalfOrTwiceTheAssumedOne) {
  VERIFIES("LASSO-REG-003~2");
  constexpr int kScans = 150;
  for (const double sigma_m : {0.5e-3, 2e-3}) {
    scan_.sigma_m = sigma_m;
    double nees = 0;
    for (int i = 0; i < kScans; ++i) {
      scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.2, 0.1, random_);
      const Registration r = estimate_from(0.005, 0.003);
      EXPECT_EQ(r.reason, sigma_m > 1e-3 ? PoseReason::kHighResidual : PoseReason::kValid);
      Vec6 x;
      ASSERT_EQ(solve6(r.covariance, error(r), x), Status::kOk);
      nees += error(r).dot(x) / kScans;
    }
    EXPECT_GT(nees, 4.8) << sigma_m;
    EXPECT_LT(nees, 7.5) << sigma_m;
  }
}

TEST_F(EstimatorTest, EstimatesTheNoiseThatItWasNotTold) {
  VERIFIES("LASSO-REG-003~2 LASSO-REG-024~1");
  scan_.sigma_m = 2e-3;
  const Registration r = estimate_from(0.005, 0.003);
  EXPECT_EQ(r.reason, PoseReason::kHighResidual);
  EXPECT_NEAR(r.normalized_residual, 2.0, 0.2);
  EXPECT_NEAR(r.rms_m, 2e-3, 6e-4);
}

// A target that moves by 0.02 m/s has moved by up to 1.8 mm at both ends of a scan of 0.18 s: that is no noise, and expected while nobody
// knows how it moves.
TEST_F(EstimatorTest, NoiseIsNotBlamedForMotionThatNobodyKnows) {
  VERIFIES("LASSO-REG-024~1");
  scan_.sigma_m = 2e-3;
  const auto image = test::scan_box(scan_, random_);
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  const Registration still = estimate(*image, start);
  EXPECT_EQ(still.reason, PoseReason::kHighResidual);
  start.rate_sigma_mps = 0.02;
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kValid);
  // At the limit: three of these sigmas, to either end of the scan, spread evenly over it.
  const double stated = parameters().sigma0_m * parameters().sigma0_m + parameters().surface_sigma_m * parameters().surface_sigma_m;
  const double tolerated = parameters().noise_tolerance * parameters().noise_tolerance;
  const double shown = still.normalized_residual * still.normalized_residual / (1 + 3 * std::sqrt(2.0 / (still.inliers - 6)));
  const double sigma_mps = std::sqrt(3 * (shown - tolerated) * stated) / (3 * 0.09);
  start.rate_sigma_mps = 0.999 * sigma_mps;
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kHighResidual);
  start.rate_sigma_mps = 1.001 * sigma_mps;
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kValid);
}

// Ranges that the sensor trusts less may be wrong all alike.
TEST_F(EstimatorTest, RangesOfLargerSigmaAreNotTrustedForTheirSmallResiduals) {
  VERIFIES("LASSO-LCS-008~2");
  const auto image = test::scan_box(scan_, random_);
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  parameters().silhouettes = 0;
  parameters().noise_estimated = 0;
  const double assumed = estimate(*image, start).covariance.trace();
  parameters().noise_estimated = 1;
  EXPECT_LT(estimate(*image, start).covariance.trace(), 0.1 * assumed) << "a scan without noise shows none";
  for (RangeSample& sample : image->samples) sample.sigma_factor = 5;
  const double doubted = estimate(*image, start).covariance.trace();
  EXPECT_GT(doubted, 15 * assumed);
  EXPECT_LT(doubted, 30 * assumed);
}

TEST_F(EstimatorTest, MovesPointsToTheReferenceTime) {
  VERIFIES("LASSO-REG-004~2 LASSO-SYS-023~1");
  scan_.rates.omega_radps = Vec3(0.06, -0.05, 0.04);
  scan_.rates.v_mps = Vec3(0.03, -0.02, 0.05);
  const Registration deskewed = estimate_from(0.005, 0.003);
  ASSERT_TRUE(deskewed.valid());
  EXPECT_LT(error(deskewed).tail<3>().norm(), 3e-5);
  EXPECT_LT(error(deskewed).head<3>().norm(), 1e-4);
  parameters().deskew = 0;
  EXPECT_GT(error(estimate_from(0.005, 0.003)).head<3>().norm(), 3e-4);  // what it would be without
}

TEST_F(EstimatorTest, WideStartConverges) {
  VERIFIES("LASSO-REG-005~1");
  for (int i = 0; i < 40; ++i) {
    StartPoint start;
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.2, 0.1, random_);
    start.wide = true;
    const Registration r = estimate(*test::scan_box(scan_, random_), start);
    EXPECT_LT(error(r).tail<3>().norm(), 1e-3) << i;
  }
}

TEST_F(EstimatorTest, OutliersAndDropoutsAreTolerated) {
  VERIFIES("LASSO-REG-006~2");
  scan_.sigma_m = 1e-3;
  scan_.outliers = 0.3;
  scan_.dropouts = 0.2;
  parameters().dropout_probability = 0.2;
  parameters().inlier_share_min = 0.3;
  parameters().agreement_min = 0.3;
  parameters().noise_tolerance = 10;
  for (int i = 0; i < 20; ++i) {
    const Registration r = estimate_from(0.005, 0.003);
    EXPECT_TRUE(r.valid()) << i << ' ' << to_string(r.reason);
    EXPECT_LT(error(r).tail<3>().norm(), 5e-3) << i;
    EXPECT_LT(error(r).head<3>().norm(), 0.01) << i;
  }
}

TEST_F(EstimatorTest, SaysWhyAPoseCannotBeTrusted) {
  VERIFIES("LASSO-REG-007~2");
  RangeImage empty;
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  const Registration nothing = estimate(empty, start);
  EXPECT_EQ(nothing.reason, PoseReason::kTooFewReturns);
  EXPECT_EQ(nothing.T_sensor_target.p, start.T_sensor_target.p);  // the start, not something invented
  const auto image = test::scan_box(scan_, random_);
  start.T_sensor_target.p[2] += 1.0;  // a metre off: no ray meets the box within the gate
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kTooFewInliers);
  start.T_sensor_target = scan_.T_sensor_target;
  start.T_sensor_target.q = exp_so3(Vec3(0, 0, 0.5)) * start.T_sensor_target.q;
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kTooFewInliers) << "half a radian of attitude off";
}

TEST_F(EstimatorTest, TheAssumedNoiseStandsWhereItIsNotEstimated) {
  VERIFIES("LASSO-REG-003~2");
  scan_.sigma_m = 2e-3;
  parameters().silhouettes = 0;
  const auto image = test::scan_box(scan_, random_);
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  const Registration estimated = estimate(*image, start);
  parameters().noise_estimated = 0;
  const Registration assumed = estimate(*image, start);
  EXPECT_EQ(assumed.T_sensor_target.p, estimated.T_sensor_target.p);
  const double scale = estimated.normalized_residual * estimated.normalized_residual;
  EXPECT_GT(scale, 3);
  EXPECT_LT((scale * assumed.covariance - estimated.covariance).norm(), 1e-12 * estimated.covariance.norm());
}

TEST_F(EstimatorTest, SaysWhatItHasWhenTheIterationsEnd) {
  VERIFIES("LASSO-REG-007~2 LASSO-REG-011~2");
  scan_.sigma_m = 1e-3;
  parameters().iterations_max = 1;
  parameters().stop_translation_m = 0;
  const Registration r = estimate_from(0.03, 0.01);
  EXPECT_EQ(r.stop, StopReason::kIterationLimit);
  EXPECT_EQ(r.reason, PoseReason::kNotConverged);
  EXPECT_LT(error(r).tail<3>().norm(), 0.01);  // better than the start
  EXPECT_GT(r.covariance.trace(), 0);
}

// Two looks, or that of a wide start, and two more where the outline moves the pose; each of two opening passes and one over all points.
TEST_F(EstimatorTest, AnEstimateHasFourLooksAtMostThatGiveItsPose) {
  VERIFIES("LASSO-REG-011~2");
  parameters().iterations_max = 1;
  parameters().stop_translation_m = 0;
  scan_.sigma_m = 1e-3;
  scan_.outliers = 0.05;
  for (int i = 0; i < 12; ++i) {
    if (i % 3 == 0) scan_.T_sensor_target.q = exp_so3(Vec3(0, 0, random_.uniform(-3, 3)));  // a face, which its outline moves
    StartPoint start;
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.1, 0.05, random_);
    start.wide = i % 2 == 0;
    const Registration r = estimate(*test::scan_box(scan_, random_), start);
    EXPECT_LE(r.iterations, 4 * (2 + 1));
    EXPECT_NE(r.stop, StopReason::kNotRun);
  }
}

TEST_F(EstimatorTest, AWideStartOfFewReturnsIsANarrowOne) {
  VERIFIES("LASSO-REG-005~1 LASSO-REG-007~2");
  scan_.side = 4;  // too few for coarse alignment
  scan_.outliers = 0.2;
  parameters().inliers_min = 12;
  for (int i = 0; i < 5; ++i) {
    const auto image = test::scan_box(scan_, random_);
    StartPoint start;
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.02, 0.01, random_);
    const Registration narrow = estimate(*image, start);
    start.wide = true;
    const Registration wide = estimate(*image, start);
    EXPECT_LT(narrow.inlier_share, 0.99);
    EXPECT_EQ(narrow.reason, PoseReason::kTooFewReturns);
    EXPECT_EQ(wide.reason, narrow.reason);
    EXPECT_EQ(wide.T_sensor_target.p, narrow.T_sensor_target.p);
  }
}

// A face without its outline holds the box so loosely in its plane that labels ask for steps far beyond the band in which they were found.
TEST_F(EstimatorTest, LabelsMoveThePoseWithinTheirBandOrNotAtAll) {
  VERIFIES("LASSO-REG-002~1");
  scan_.side = 48;
  scan_.sigma_m = 1e-3;
  int used = 0;
  int dropped = 0;
  for (int i = 0; i < 40; ++i) {
    scan_.T_sensor_target.q = i % 2 == 0 ? Quat(1, 0, 0, 0) : test::generic_box_pose().q;
    const auto image = test::scan_box(scan_, random_);
    StartPoint start;
    start.partial = true;
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0, 0.01, random_);
    parameters().silhouettes = 0;
    const Registration hits = estimate(*image, start);
    parameters().silhouettes = 1;
    const Registration r = estimate(*image, start);
    const Vec3 step = r.T_sensor_target.p - hits.T_sensor_target.p;
    if (r.labels == 0) {
      EXPECT_EQ(step, Vec3(Vec3::Zero()));
    }
    EXPECT_LT(step.norm(), parameters().silhouette_band_m);
    ++(r.labels == 0 ? dropped : used);
  }
  EXPECT_GT(used, 15);
  EXPECT_GT(dropped, 15);
}

TEST_F(EstimatorTest, ReportsWeakDirections) {
  VERIFIES("LASSO-REG-008~2 LASSO-REG-021~1");
  // One face alone, all other rays unknown: nothing holds the box in its plane.
  parameters().silhouettes = 0;
  scan_.T_sensor_target.q = Quat(1, 0, 0, 0);
  scan_.half_angle = 0.04;
  for (const double sigma_m : {0.0, 1e-3}) {
    scan_.sigma_m = sigma_m;
    const Registration r = estimate_from(0.0, 0.0);
    EXPECT_EQ(r.weak, 3);  // two shifts in the plane and the turn about its normal
    EXPECT_GT(r.weakest_sigma_m, mission_->radius_m);
  }
}

TEST_F(EstimatorTest, PointCloudsWithoutMissesAreRegistered) {
  VERIFIES("LASSO-REG-009~1");
  scan_.sigma_m = 1e-3;
  const auto image = test::scan_box(scan_, random_);
  image->misses_known = false;
  StartPoint start;
  start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.005, 0.003, random_);
  const Registration r = estimate(*image, start);
  EXPECT_TRUE(r.valid());
  EXPECT_EQ(r.labels, 0);  // a box alone has outer contours only
}

TEST_F(EstimatorTest, TheSameInputGivesTheSameBits) {
  VERIFIES("LASSO-REG-010~1");
  scan_.sigma_m = 1e-3;
  const auto image = test::scan_box(scan_, random_);
  StartPoint start;
  start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.005, 0.003, random_);
  const Registration first = estimate(*image, start);
  (void)estimate_from(0.01, 0.01);  // another scan in between leaves no trace
  const Registration second = estimate(*image, start);
  EXPECT_EQ(first.T_sensor_target.p, second.T_sensor_target.p);
  EXPECT_EQ(first.T_sensor_target.q.coeffs(), second.T_sensor_target.q.coeffs());
  EXPECT_EQ(first.covariance, second.covariance);
}

// One noisy scan from twelve predictions, each a few sigmas of the pose off in its own direction: what comes out is the scan's, not theirs.
TEST_F(EstimatorTest, ThePredictionIsWhereItBeginsAndNoMeasurement) {
  VERIFIES("LASSO-REG-014~2");
  scan_.sigma_m = 1e-3;
  const auto image = test::scan_box(scan_, random_);
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  const Registration reference = estimate(*image, start);
  ASSERT_TRUE(reference.valid()) << to_string(reference.reason);
  for (int i = 0; i < 12; ++i) {
    start.T_sensor_target = test::disturb(scan_.T_sensor_target, 0.01, 0.005, random_);
    const Vec6 offset = pose_difference(start.T_sensor_target, scan_.T_sensor_target);
    const Registration r = estimate(*image, start);
    ASSERT_TRUE(r.valid()) << to_string(r.reason);
    const Vec6 moved = pose_difference(r.T_sensor_target, reference.T_sensor_target);
    Vec6 x, far;
    ASSERT_EQ(solve6(reference.covariance, moved, x), Status::kOk);
    ASSERT_EQ(solve6(reference.covariance, offset, far), Status::kOk);
    EXPECT_GT(offset.dot(far), 9) << "a start that a filter would have had to pull in";
    EXPECT_LT(moved.dot(x), 0.01) << "a tenth of a sigma";
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(r.covariance(k, k) / reference.covariance(k, k), 1, 0.05) << k;
  }
}

TEST_F(EstimatorTest, SomeTargetsAreTooFastToMoveTheirPointsBack) {
  VERIFIES("LASSO-REG-019~1");
  const auto too_fast = [this](const Vec3& omega_radps, const Vec3& v_mps, double half_scan_s) {
    return is_too_fast(parameters(), Twist{omega_radps, v_mps}, half_scan_s);
  };
  const Vec3 zero = Vec3::Zero();
  const Vec3 axis = Vec3(0.6, 0, -0.8);
  EXPECT_FALSE(too_fast(0.99 * kMostTurn_rad / 0.1 * axis, zero, 0.1));
  EXPECT_TRUE(too_fast(1.01 * kMostTurn_rad / 0.1 * axis, zero, 0.1));
  EXPECT_FALSE(too_fast(zero, 0.99 * kMostWay_m / 1.5 * axis, 1.5));
  EXPECT_TRUE(too_fast(zero, 1.01 * kMostWay_m / 1.5 * axis, 1.5));
  EXPECT_FALSE(too_fast(0.99 * kFastestTurn_radps * axis, 0.99 * kFastest_mps * axis, 0)) << "a flash";
  EXPECT_TRUE(too_fast(1.01 * kFastestTurn_radps * axis, zero, 0));
  EXPECT_TRUE(too_fast(zero, 1.01 * kFastest_mps * axis, 0));
  EXPECT_TRUE(too_fast(std::numeric_limits<double>::quiet_NaN() * axis, zero, 0.1));
  parameters().deskew = 0;
  EXPECT_FALSE(too_fast(100 * axis, zero, 1)) << "where nothing is moved";
}

// 0.18 s, half of which is 0.09 s.
TEST_F(EstimatorTest, AScanOfATargetThatIsTooFastGivesNoPose) {
  VERIFIES("LASSO-REG-019~1 LASSO-REG-007~2");
  const auto image = test::scan_box(scan_, random_);
  const std::size_t last = image->samples.size() - 1;
  const double half_s = 0.5 * to_seconds(image->samples[last].t_us - image->samples[0].t_us);
  StartPoint start;
  start.T_sensor_target = scan_.T_sensor_target;
  start.rates.omega_radps = Vec3(0, 0.98 * kMostTurn_rad / half_s, 0);
  EXPECT_NE(estimate(*image, start).reason, PoseReason::kTooFast);
  start.rates.omega_radps = Vec3(0, 1.02 * kMostTurn_rad / half_s, 0);
  const Registration refused = estimate(*image, start);
  EXPECT_EQ(refused.reason, PoseReason::kTooFast);
  EXPECT_EQ(refused.stop, StopReason::kNotRun);
  EXPECT_EQ(refused.t_us, image->reference_time_us());
  EXPECT_EQ(refused.T_sensor_target.p, start.T_sensor_target.p);
  EXPECT_NE(estimate(RangeImage(), start).reason, PoseReason::kTooFast) << "no scan, no time in it";
  for (RangeSample& sample : image->samples) sample.state = RayState::kMiss;
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kTooFast) << "before it is asked for returns";
  start.rates = Twist{};
  EXPECT_EQ(estimate(*image, start).reason, PoseReason::kTooFewReturns);
}

}  // namespace
}  // namespace lasso
