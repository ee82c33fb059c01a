#include "fsw/pose/registration/common_error.hpp"

#include "ut/pose/estimator_fixture.hpp"
#include "ut/pose/filter_fixture.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {
namespace {

class CommonErrorTest : public EstimatorTest {
 protected:
  CommonErrorTest() {
    scan_.sigma_m = 0;
    parameters().silhouettes = 0;
    parameters().noise_estimated = 0;  // a scan without noise would claim to be without error
    parameters().stop_translation_m = 1e-7;
  }

  static double error_m(const MissionParameters& p, double range_m) {
    return p.common_sigma_m + p.common_sigma_k_per_m * range_m * range_m;
  }
  // A scan whose returns are all off by `sigmas` of the common range error, and whose rays are turned by `turn`.
  std::unique_ptr<RangeImage> scan_with(double sigmas, const Vec3& turn_rad) {
    auto image = scan_box(scan_, random_);
    const Mat3 turn = to_matrix(exp_so3(turn_rad));
    for (RangeSample& sample : image->samples) {
      const Vec3 u = turn * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
      for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(u[i]);
      if (sample.state != RayState::kHit) continue;
      const double range_m = static_cast<double>(sample.range_m);
      sample.range_m = static_cast<float>(range_m + sigmas * error_m(parameters(), range_m));
    }
    return image;
  }
  Registration registered(double sigmas, const Vec3& turn_rad = Vec3::Zero()) {
    StartPoint start;
    start.T_sensor_target = scan_.T_sensor_target;
    return estimate(*scan_with(sigmas, turn_rad), start);
  }
};

// Half the difference of two registrations of scans that are off to either side.
TEST_F(CommonErrorTest, ARangeErrorMovesThePoseAsRegistrationsOfShiftedScansDo) {
  VERIFIES("LASSO-REG-030~1");
  for (const double k : {0.0, 5e-4}) {
    parameters().common_sigma_m = 2e-3;
    parameters().common_sigma_k_per_m = k;
    for (int trial = 0; trial < 5; ++trial) {
      scan_.T_sensor_target.q = normalized(scan_.T_sensor_target.q * exp_so3(Vec3(0.3, -0.2, 0.1)));
      const CommonErrors common = registered(0).common;
      const Vec6 moved = 0.5 * pose_difference(registered(0.5).T_sensor_target, registered(-0.5).T_sensor_target) / 0.5;
      EXPECT_LT((common.col(0) - moved).norm(), 0.05 * moved.norm()) << k << "\n" << common.col(0).transpose() << "\n" << moved.transpose();
      EXPECT_GT(moved.norm(), 1e-3);
    }
  }
}

TEST_F(CommonErrorTest, ATurnOfTheRaysTurnsThePoseAboutTheSensor) {
  VERIFIES("LASSO-REG-030~1");
  parameters().common_sigma_rad = 2e-3;
  const Registration straight = registered(0);
  for (int axis = 0; axis < 3; ++axis) {
    const Registration turned = registered(0, 2e-3 * Vec3::Unit(axis));
    const Vec6 moved = pose_difference(turned.T_sensor_target, straight.T_sensor_target);
    EXPECT_LT((straight.common.col(1 + axis) - moved).norm(), 0.02 * moved.norm()) << axis;
  }
  EXPECT_TRUE(straight.common.col(0).isZero(0.0)) << "no range error is stated";
}

TEST_F(CommonErrorTest, TheCovarianceHoldsThemAndThePoseOfHitsIsAsWithout) {
  VERIFIES("LASSO-REG-030~1");
  parameters().noise_estimated = 1;
  scan_.sigma_m = 1e-3;
  const Generator same = random_;
  const Registration without = registered(0);
  EXPECT_TRUE(without.common.isZero(0.0));
  parameters().common_sigma_m = 3e-3;
  parameters().common_sigma_rad = 1e-3;
  random_ = same;
  const Registration with = registered(0);
  EXPECT_TRUE(with.T_sensor_target.p == without.T_sensor_target.p && with.T_sensor_target.q.coeffs() == without.T_sensor_target.q.coeffs());
  const Mat6 grown = without.covariance + with.common * with.common.transpose();
  EXPECT_LT((with.covariance - grown).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(std::sqrt(with.covariance(5, 5)), 2e-3) << "along the boresight most of the range error is the pose's";
}

// Noise, silhouettes, and a range error of each scan's own: the errors keep within the covariance, and right poses are valid.
TEST_F(CommonErrorTest, PosesOfNoisyScansWithSilhouettesAreWithinTheirCovariance) {
  VERIFIES("LASSO-REG-030~1 LASSO-REG-029~2");
  parameters().silhouettes = parameters().noise_estimated = 1;
  parameters().stop_translation_m = 1e-4;
  parameters().common_sigma_m = 0.003;  // three times the noise: farther off, labels are not linear
  parameters().common_sigma_rad = 2e-3;
  scan_.sigma_m = 1e-3;
  constexpr int kScans = 120;
  double squares = 0;
  int valid = 0;
  for (int i = 0; i < kScans; ++i) {
    scan_.T_sensor_target = random_box_pose(random_);
    const double sigmas = random_.normal();
    const Registration r = registered(sigmas, 2e-3 * normals<Vec3>(random_));
    if (!r.valid()) continue;
    ++valid;
    squares += error(r).dot(Vec6(solution_of(r.covariance, error(r))));
  }
  EXPECT_GT(valid, 0.95 * kScans);
  EXPECT_GT(squares / valid, 4);
  EXPECT_LT(squares / valid, 8);
}

TEST_F(CommonErrorTest, AStepThatOtherMeasurementsShareInShrinksAsTheCovarianceDoes) {
  VERIFIES("LASSO-REG-030~1");
  Vec6 step;
  step << 1e-3, -2e-3, 0, 3e-3, 0, 0.01;
  const Mat6 white = covariance_of(random_, 1e-3, 2e-3);
  const Mat6 before = white + step * step.transpose();
  // A further measurement of the pose with covariance R: the state's error becomes (I - K) e, K = before (before + R)^-1.
  const Mat6 R = covariance_of(random_, 2e-3, 1e-3);
  const Mat6 K = before * Mat6(inverse_of(before + R));
  const Mat6 after = before - K * before;
  EXPECT_LT((step_after(step, before, after) - (step - K * step)).norm(), 1e-6 * step.norm());
  Mat6 singular = before;
  singular.row(1) = singular.row(0);
  singular.col(1) = singular.col(0);
  EXPECT_TRUE(step_after(step, singular, after).isZero(0.0));
}

// Whatever the covariance claims, and however fine the noise is.
TEST_F(CommonErrorTest, AStepIsBoundedByItsErrorAndNoFinerThanTheNumbers) {
  VERIFIES("LASSO-REG-030~1");
  parameters().common_sigma_m = 1e-3;
  const Registration known = registered(0);
  KnownPose hits{inverse(known.T_sensor_target), Mat6::Identity() * 1e-6, 1, 1, 1e-3};
  const Vec6 step = range_step(*mission_, hits, estimator_->workspace());
  hits.range_sigma_m = 1e-9;
  EXPECT_LT((range_step(*mission_, hits, estimator_->workspace()) - step).norm(), 0.1 * step.norm());
  hits.range_sigma_m = 1e-3;
  hits.covariance *= 1e9;  // a direction that nothing shows
  const Vec6 longest = range_step(*mission_, hits, estimator_->workspace());
  EXPECT_NEAR(longest.tail<3>().norm() + mission_->radius_m * longest.head<3>().norm(), 4e-3, 1e-6);
  EXPECT_GT(longest.normalized().dot(step.normalized()), 0.99);
  parameters().common_sigma_m = 0;
  EXPECT_TRUE(range_step(*mission_, hits, estimator_->workspace()).isZero(0.0));
}

// Points are moved to ask them, and moved back.
TEST_F(CommonErrorTest, PointsStayWhereTheyAre) {
  VERIFIES("LASSO-REG-030~1");
  const auto& points = estimator_->workspace().points;
  (void)registered(0);
  const auto before = points;
  parameters().common_sigma_m = 0.02;
  parameters().common_sigma_k_per_m = 1e-3;
  (void)registered(0);
  ASSERT_EQ(points.size(), before.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(FlightNumber::to_double(points[i].p[axis]), FlightNumber::to_double(before[i].p[axis]), 3e-6);
    }
  }
}

}  // namespace
}  // namespace lasso::test
