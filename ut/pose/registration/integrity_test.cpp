#include "fsw/pose/registration/integrity.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <iterator>

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class WeakDirectionsTest : public test::PoseFixture {
 protected:
  // A covariance with the given sigmas [m] along orthogonal directions, rotation scaled by the radius.
  void make_covariance(const Vec6& sigmas_m) {
    Mat6 A;
    for (int i = 0; i < 36; ++i) A.data()[i] = random_.uniform(-1, 1);
    axes_ = test::orthogonal_of(A);
    Vec6 scale = Vec6::Ones();
    scale.head<3>().setConstant(1 / mission_.radius_m);
    const Mat6 scaled = axes_ * sigmas_m.cwiseAbs2().asDiagonal() * axes_.transpose();
    result_.covariance = scale.asDiagonal() * scaled * scale.asDiagonal();
  }
  Mat6 axes_;
  Registration result_;
};

TEST_F(WeakDirectionsTest, AreThoseOfTheCovariance) {
  VERIFIES("LASSO-REG-008~2");
  parameters().sigma_position_max_m = 0.05;
  parameters().sigma_attitude_max_rad = 3.0;
  for (int i = 0; i < 20; ++i) {
    Vec6 sigmas;
    sigmas << 1e-4, 0.06, 2e-3, 0.3, 0.049, 0.051;
    make_covariance(sigmas);
    find_weak_directions(mission_, result_);
    EXPECT_EQ(result_.weak, 3);
    EXPECT_NEAR(result_.weakest_sigma_m, 0.3, 1e-9);
    EXPECT_NEAR(std::abs(result_.weakest_direction.dot(axes_.col(3))), 1, 1e-9);
    EXPECT_NEAR(result_.weakest_direction.norm(), 1, 1e-12);
  }
}

TEST_F(WeakDirectionsTest, AreMeasuredByTheTighterLimit) {
  VERIFIES("LASSO-REG-008~2");
  parameters().sigma_position_max_m = 0.05;
  parameters().sigma_attitude_max_rad = 0.01 / mission_.radius_m;
  Vec6 sigmas;
  sigmas << 0.009, 0.011, 0.04, 0.001, 0.0099, 0.0101;
  make_covariance(sigmas);
  find_weak_directions(mission_, result_);
  EXPECT_EQ(result_.weak, 3);
  EXPECT_NEAR(result_.weakest_sigma_m, 0.04, 1e-9);
}

TEST_F(WeakDirectionsTest, ThereAreNoneInAGoodPose) {
  VERIFIES("LASSO-REG-008~2");
  make_covariance(Vec6::Constant(1e-4));
  find_weak_directions(mission_, result_);
  EXPECT_EQ(result_.weak, 0);
  EXPECT_NEAR(result_.weakest_sigma_m, 1e-4, 1e-12);
}

Registration good_result() {
  Registration r;
  r.stop = StopReason::kConverged;
  r.returns = 400;
  r.inliers = 390;
  r.inlier_share = 0.97;
  r.agreement = 0.99;
  r.normalized_residual = 1.1;
  return r;
}

PoseReason judge_with(void (*spoil)(const MissionParameters&, Registration&)) {
  const MissionParameters p = preset_parameters();
  Registration r = good_result();
  spoil(p, r);
  return judge(p, r, 0);
}

TEST(Judge, NamesTheCheckThatFails) {
  VERIFIES("LASSO-REG-007~2");
  using P = const MissionParameters&;
  using R = Registration&;
  EXPECT_EQ(judge_with([](P, R) {}), PoseReason::kValid);
  EXPECT_EQ(judge_with([](P p, R r) { r.returns = static_cast<std::uint16_t>(p.inliers_min - 1); }), PoseReason::kTooFewReturns);
  EXPECT_EQ(judge_with([](P, R r) { r.stop = StopReason::kSingular; }), PoseReason::kSingular);
  EXPECT_EQ(judge_with([](P, R r) { r.stop = StopReason::kTooFewPoints; }), PoseReason::kTooFewInliers);
  EXPECT_EQ(judge_with([](P p, R r) { r.inliers = static_cast<std::uint16_t>(p.inliers_min - 1); }), PoseReason::kTooFewInliers);
  EXPECT_EQ(judge_with([](P, R r) { r.stop = StopReason::kIterationLimit; }), PoseReason::kNotConverged);
  EXPECT_EQ(judge_with([](P p, R r) { r.inlier_share = p.inlier_share_min - 1e-9; }), PoseReason::kLowInlierShare);
  EXPECT_EQ(judge_with([](P p, R r) { r.agreement = p.agreement_min - 1e-9; }), PoseReason::kModelMismatch);
  EXPECT_EQ(judge_with([](P, R r) { r.normalized_residual = std::nan(""); }), PoseReason::kHighResidual);
}

// Of each two that hold the one that stands first is told.
TEST(Judge, NamesTheFirstOfTheChecksThatFail) {
  VERIFIES("LASSO-REG-007~2");
  using P = const MissionParameters&;
  using R = Registration&;
  struct Failure {
    PoseReason reason;
    void (*spoil)(P, R);
  };
  const Failure in_order[] = {
      {PoseReason::kTooFewReturns, [](P p, R r) { r.returns = static_cast<std::uint16_t>(p.inliers_min - 1); }},
      {PoseReason::kSingular, [](P, R r) { r.stop = StopReason::kSingular; }},
      {PoseReason::kTooFewInliers, [](P p, R r) { r.inliers = static_cast<std::uint16_t>(p.inliers_min - 1); }},
      {PoseReason::kNotConverged, [](P, R r) { r.stop = StopReason::kIterationLimit; }},
      {PoseReason::kLowInlierShare, [](P p, R r) { r.inlier_share = p.inlier_share_min - 1e-9; }},
      {PoseReason::kModelMismatch, [](P p, R r) { r.agreement = p.agreement_min - 1e-9; }},
      {PoseReason::kHighResidual, [](P, R r) { r.normalized_residual = 1e3; }},
  };
  const MissionParameters p = preset_parameters();
  for (const Failure& first : in_order) {
    for (const Failure* other = &first; other != std::end(in_order); ++other) {
      Registration r = good_result();
      other->spoil(p, r);
      first.spoil(p, r);  // a registration stops for one reason
      EXPECT_EQ(judge(p, r, 0), first.reason) << to_string(first.reason) << " and " << to_string(other->reason);
    }
  }
}

TEST(Judge, LimitsThemselvesAreValid) {
  VERIFIES("LASSO-REG-007~2");
  const MissionParameters p = preset_parameters();
  Registration r = good_result();
  r.returns = r.inliers = static_cast<std::uint16_t>(p.inliers_min);
  r.inlier_share = p.inlier_share_min;
  r.agreement = p.agreement_min;
  EXPECT_EQ(judge(p, r, 0), PoseReason::kValid);
}

// The share of scans whose Gaussian residuals have exactly the noise that is tolerated, drawn as chi-squared numbers, is that beyond three
// sigmas (the distribution of so many degrees is a little skew); 1.2 times as much is nearly always refused.
TEST(Judge, NoiseIsTheStatedOneTimesItsTolerance) {
  VERIFIES("LASSO-REG-007~2 LASSO-REG-024~1");
  const MissionParameters p = preset_parameters();
  Registration r = good_result();
  test::Generator generator(7);
  const auto refused = [&](double sigma, double motion) {
    int count = 0;
    for (int scan = 0; scan < 2000; ++scan) {
      double sum = 0;
      for (int i = 0; i < r.inliers - 6; ++i) sum += std::pow(sigma * generator.normal(), 2);
      r.normalized_residual = std::sqrt(sum / (r.inliers - 6));
      count += judge(p, r, motion) == PoseReason::kHighResidual ? 1 : 0;
    }
    return count;
  };
  EXPECT_LE(refused(p.noise_tolerance, 0), 12);
  EXPECT_GE(refused(1.2 * p.noise_tolerance, 0), 1980);
  EXPECT_LE(refused(1.2 * p.noise_tolerance, 0.44 * p.noise_tolerance * p.noise_tolerance), 12) << "the target may move";
}

TEST(Judge, TheLimitOfTheResidualsIsWhereTheEquationHasIt) {
  VERIFIES("LASSO-REG-024~1");
  MissionParameters p = preset_parameters();
  Registration r = good_result();
  for (const std::uint16_t inliers : {std::uint16_t{60}, std::uint16_t{390}}) {
    r.inliers = inliers;
    for (const double motion : {0.0, 0.7}) {
      for (const double tolerance : {1.0, 1.5, 4.0}) {
        p.noise_tolerance = tolerance;
        const double limit = (1 + 3 * std::sqrt(2.0 / (inliers - 6))) * (tolerance * tolerance + motion);
        r.normalized_residual = std::sqrt(limit * (1 - 1e-9));
        EXPECT_EQ(judge(p, r, motion), PoseReason::kValid);
        r.normalized_residual = std::sqrt(limit * (1 + 1e-9));
        EXPECT_EQ(judge(p, r, motion), PoseReason::kHighResidual);
      }
    }
  }
}

TEST(Judge, NothingRunIsNotValid) {
  VERIFIES("LASSO-REG-007~2");
  EXPECT_EQ(judge(preset_parameters(), Registration(), 0), PoseReason::kTooFewReturns);
}

}  // namespace
}  // namespace lasso
