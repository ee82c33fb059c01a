#include "fsw/pose/registration/weak_axis.hpp"

#include <cmath>

#include "fsw/geometry/symmetric6.hpp"
#include "ut/pose/beam_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class WeakAxisTest : public test::PeggedBeamTest {
 protected:
  WeakAxisTest() { scan_.sigma_m = parameters().sigma0_m = 0.01; }
  // A registration that stands a turn off, as Gauss-Newton leaves some.
  HitSolution region_costs(double turn_rad) {
    HitSolution hits = weigh_hits(mission_, turned(turn_rad), *workspace_);
    hits.stop = StopReason::kConverged;
    return hits;
  }
  // Of the turn's information all but `share` is taken: its axis is the least certain one, with a sigma that is as much larger.
  static void loosen(double share, HitSolution& hits) {
    const Vec6 row = hits.H.col(0) / std::sqrt(hits.H(0, 0));
    hits.H -= (1 - share) * row * row.transpose();
  }
};

TEST_F(WeakAxisTest, AWrongTurnGivesPlaceToTheRightOne) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  HitSolution hits = region_costs(0.05);
  loosen(1e-4, hits);
  minimise_weak_axis(mission_, tracked_at(turned(0.06)), *workspace_, hits);
  EXPECT_LT(std::abs(turn_of(hits.T_target_sensor)), 0.03);
}

// Its sigma is a 500th of the radius or less.
TEST_F(WeakAxisTest, AnAxisThatIsCertainIsLeftNearThePredictionAlone) {
  VERIFIES("LASSO-REG-031~2");
  scan_.sigma_m = parameters().sigma0_m = 1e-3;
  scan();
  HitSolution hits = region_costs(0.02);
  loosen(0.5, hits);
  Directions unobservable;
  const Mat6 covariance = covariance_of_hits(mission_.radius_m, hits.H, 1, unobservable);
  const Eigen6 axes = axes_at_radius(covariance, mission_.radius_m);
  ASSERT_LT(std::sqrt(axes.values[5]), 0.002 * mission_.radius_m);
  const HitSolution before = hits;
  const auto predicted_at = [&](double sigmas) {
    const Vec6 step = sigmas * std::sqrt(axes.values[5]) * axes.vectors.col(5).cwiseQuotient(radius_scale(mission_.radius_m));
    return step_pose(before.T_target_sensor, step);
  };
  for (const double sigmas : {-4.9, 0.0, 4.9}) {
    minimise_weak_axis(mission_, tracked_at(predicted_at(sigmas)), *workspace_, hits);
    EXPECT_EQ(hits.T_target_sensor.p, before.T_target_sensor.p) << sigmas;
  }
  for (const double sigmas : {-5.1, 5.1}) {
    StartPoint start = tracked_at(predicted_at(sigmas));
    start.tracked = false;
    minimise_weak_axis(mission_, start, *workspace_, hits);
    EXPECT_EQ(hits.T_target_sensor.p, before.T_target_sensor.p) << "no track: " << sigmas;
    start.tracked = true;
    minimise_weak_axis(mission_, start, *workspace_, hits);
    EXPECT_NE(hits.T_target_sensor.p, before.T_target_sensor.p) << sigmas;
    hits = before;
  }
}

TEST_F(WeakAxisTest, WithoutInformationOrInliersThePoseStays) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  HitSolution hits = region_costs(0.05);
  loosen(1e-4, hits);
  for (const StopReason stop : {StopReason::kTooFewPoints, StopReason::kSingular, StopReason::kNotRun}) {
    HitSolution nothing = hits;
    nothing.stop = stop;
    minimise_weak_axis(mission_, tracked_at(truth()), *workspace_, nothing);
    EXPECT_EQ(nothing.T_target_sensor.p, hits.T_target_sensor.p);
    EXPECT_EQ(nothing.stop, stop);
  }
  HitSolution unexplained = hits;
  unexplained.inliers = 1;
  minimise_weak_axis(mission_, tracked_at(truth()), *workspace_, unexplained);
  EXPECT_EQ(unexplained.inliers, 1u);
  hits.stop = StopReason::kIterationLimit;
  minimise_weak_axis(mission_, tracked_at(truth()), *workspace_, hits);
  EXPECT_LT(std::abs(turn_of(hits.T_target_sensor)), 0.03) << "it moves";
}

// A beam that is longer than the field says nothing of its place along itself. That hides nothing of its turn.
TEST_F(WeakAxisTest, BesideAnAxisThatNothingTellsTheNextIsLookedAt) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  keep_points([this](std::size_t, const MatchPoint<FlightNumber>& point) {
    const Vec3 p(FlightNumber::to_double(point.p[0]), FlightNumber::to_double(point.p[1]), FlightNumber::to_double(point.p[2]));
    return std::abs((truth() * p)[0]) < 0.12;
  });
  HitSolution hits = region_costs(0.05);
  loosen(1e-2, hits);
  Directions unobservable;
  (void)covariance_of_hits(mission_.radius_m, hits.H, 1, unobservable);
  ASSERT_EQ(unobservable.count, 1);
  minimise_weak_axis(mission_, tracked_at(turned(0.06)), *workspace_, hits);
  EXPECT_LT(std::abs(turn_of(hits.T_target_sensor)), 0.03);
}

// Sigmas that are too small by a known factor, of axes that the hits show.
class WidenTest : public test::BeamTest {
 protected:
  WidenTest() {
    scan_.sigma_m = 0.02;
    parameters().sigma0_m = 0.02;
    scan_.side = 32;
  }
  Mat6 honest(const HitSolution& hits) {
    Directions unobservable;
    return covariance_of_hits(mission_.radius_m, hits.H, 1, unobservable);
  }
  Vec6 axis_sigmas_m(const Mat6& covariance) const {
    const Vec6 scale = radius_scale(mission_.radius_m);
    return eigen6(scale.asDiagonal() * covariance * scale.asDiagonal()).values.cwiseSqrt();
  }
  Mat6 widened(const HitSolution& hits, const Mat6& covariance, Directions& unobservable) {
    Mat6 wide = covariance;
    widen_weak_axes(mission_, hits, 1, *workspace_, wide, unobservable);
    return wide;
  }
};

TEST_F(WidenTest, AnHonestSigmaIsDoubledOnceAtMost) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  const HitSolution hits = registered(truth());
  Directions unobservable;
  const Mat6 covariance = honest(hits);
  ASSERT_GT(axis_sigmas_m(covariance)[5], 0.002 * mission_.radius_m);
  const Vec6 before = axis_sigmas_m(covariance);
  const Vec6 after = axis_sigmas_m(widened(hits, covariance, unobservable));
  for (int i = 0; i < 6; ++i) EXPECT_LT(after[i], 2.01 * before[i]) << i;
  EXPECT_GT(after[5], 0.999 * before[5]);
  EXPECT_EQ(unobservable.count, 0);
}

// The cost rises with the square: a sigma that is short by f > 5/4 is doubled until it is short by less.
TEST_F(WidenTest, ASigmaThatIsTooSmallIsDoubledUntilTheCostRises) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  const HitSolution hits = registered(truth());
  const Mat6 covariance = honest(hits);
  const double sigma_m = axis_sigmas_m(covariance)[5];
  for (const double factor : {2.0, 4.0, 6.0}) {
    if (sigma_m / factor < 0.0021 * mission_.radius_m) continue;
    Directions unobservable;
    const double found_m = axis_sigmas_m(widened(hits, covariance / (factor * factor), unobservable))[5];
    EXPECT_GT(found_m, 0.7 * sigma_m) << factor;
    EXPECT_LT(found_m, 2.1 * sigma_m) << factor;
    EXPECT_EQ(unobservable.count, 0);
  }
}

TEST_F(WidenTest, AnAxisAlongWhichNothingRisesIsUnseen) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  HitSolution hits = registered(truth());
  hits.usable = 0;  // no return counts: the cost is the same everywhere
  Directions unobservable;
  const Mat6 covariance = honest(hits);
  const Mat6 wide = widened(hits, covariance, unobservable);
  ASSERT_GT(unobservable.count, 0);
  EXPECT_NEAR(axis_sigmas_m(wide)[5], kUnobservableSigma * mission_.radius_m, 1e-3 * mission_.radius_m);
}

// Where residuals show nine times the assumed variance, the information that is believed is a ninth, and the cost has to rise nine times as
// much: a covariance that does not know of it is short by a factor of three.
TEST_F(WidenTest, TheCostHasToRiseByTheNoiseThatResidualsShow) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  const HitSolution hits = registered(truth());
  Mat6 covariance = honest(hits);
  const double sigma_m = axis_sigmas_m(covariance)[5];
  Directions unobservable;
  widen_weak_axes(mission_, hits, 9, *workspace_, covariance, unobservable);
  EXPECT_GT(axis_sigmas_m(covariance)[5], 0.7 * 3 * sigma_m);
  EXPECT_LT(axis_sigmas_m(covariance)[5], 8.1 * sigma_m) << "a bounded cost rises less far off";
  EXPECT_EQ(unobservable.count, 0);
}

TEST_F(WidenTest, AxesAreTriedFromAFiveHundredthToAFifthOfTheRadius) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  HitSolution hits = registered(truth());
  hits.usable = 0;  // nothing rises: what is tried is unseen
  const Vec6 inverse = radius_scale(mission_.radius_m).cwiseInverse();
  for (const double share : {0.0019, 0.0021, 0.199, 0.201}) {
    const double sigma_m = share * mission_.radius_m;
    const Mat6 covariance = (sigma_m * sigma_m * inverse.cwiseAbs2()).asDiagonal();
    const bool tried = share > 0.002 && share < 0.2;
    Directions unobservable;
    EXPECT_EQ(widened(hits, covariance, unobservable) != covariance, tried) << share;
    EXPECT_EQ(unobservable.count, tried ? 6 : 0) << share;
  }
}

TEST_F(WidenTest, AxesThatAreCertainAreNotTried) {
  VERIFIES("LASSO-REG-025~3");
  scan();
  HitSolution hits = registered(truth());
  hits.usable = 0;
  Directions unobservable;
  const Mat6 certain = 1e-8 * Mat6::Identity();
  EXPECT_EQ(widened(hits, certain, unobservable), certain);
}

}  // namespace
}  // namespace lasso
