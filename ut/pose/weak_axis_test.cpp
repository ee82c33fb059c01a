#include "fsw/pose/weak_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/estimator.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kQuarterTurn_rad = 90 * kRadPerDeg;

// A beam with a square section looks the same after a quarter turn about its axis, x. Its peg does not.
test::BoxModel beam() { return {{0, 0, 0}, {0.30, 0.08, 0.08}, 0.02, 0.2}; }
test::BoxModel peg() { return {{0.15, 0, -0.10}, {0.02, 0.02, 0.02}, 0.02, 0.2}; }

const Mission& plain_mission() {
  static const test::LoadedImage loaded(test::Boxes{beam()});
  return loaded.mission;
}
const Mission& pegged_mission() {
  static const test::LoadedImage loaded(test::Boxes{beam(), peg()});
  return loaded.mission;
}

class BeamTest : public test::PoseFixture {
 protected:
  explicit BeamTest(const Mission& mission = plain_mission()) : PoseFixture(mission) {
    scan_.model = beam();
    scan_.sigma_m = 1e-3;
    scan_.T_sensor_target.q = exp_so3(Vec3(0.7, 0.35, 0.2));
    scan_.T_sensor_target.p = Vec3(0.03, -0.02, 2.5);
  }

  // Known but for its turn about the beam.
  PriorPose prior(const Pose& T_target_sensor, double turn_sigma_rad) const {
    PriorPose prior{T_target_sensor, 1e-6 * Mat6::Identity()};
    prior.covariance(0, 0) = turn_sigma_rad * turn_sigma_rad;
    return prior;
  }
  Pose turned(double angle_rad) const { return step_of(angle_rad) * truth(); }
  HitSolution registered(const Pose& T_target_sensor) { return register_first(mission_, T_target_sensor, *workspace_); }
  LineSearch searched(const PriorPose& prior, const HitSolution& near) {
    LineSearch search;
    search.best = near;
    search_weak_axis(mission_, prior, *workspace_, search);
    return search;
  }
  double turn_of(const Pose& T_target_sensor) const { return log_so3(T_target_sensor.q * truth().q.conjugate())[0]; }

 private:
  static Pose step_of(double angle_rad) {
    Pose step;
    step.q = exp_so3(Vec3(angle_rad, 0, 0));
    return step;
  }
};

class PeggedBeamTest : public BeamTest {
 protected:
  PeggedBeamTest() : BeamTest(pegged_mission()) { scan_.others = {peg()}; }
};

// By chance the one or the other costs less.
TEST_F(BeamTest, AQuarterTurnThatTheScanCannotTellIsARival) {
  VERIFIES("LASSO-REG-027~1");
  int moved = 0;
  constexpr int kScans = 8;
  for (int i = 0; i < kScans; ++i) {
    scan();
    const LineSearch search = searched(prior(truth(), 0.4), registered(truth()));
    ASSERT_GT(search.rivals.size(), 0u);
    EXPECT_FALSE(search.contradicted);
    const double turns = turn_of(search.rivals[0]) / kQuarterTurn_rad;
    EXPECT_NEAR(turns, std::round(turns), 0.02);
    EXPECT_GT(std::abs(turn_of(search.rivals[0]) - turn_of(search.best.T_target_sensor)), 0.9 * kQuarterTurn_rad);
    EXPECT_GT(search.rival_m, kQuarterTurn_rad * mission_.radius_m);
    const Mat6 whole = with_rivals(search, 1e-6 * Mat6::Identity());
    EXPECT_GT(whole(0, 0), 0.24 * kQuarterTurn_rad * kQuarterTurn_rad) << "either of both lies within two sigmas of the other";
    if (std::abs(turn_of(search.best.T_target_sensor)) > 1) ++moved;
  }
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, kScans);
}

TEST_F(BeamTest, WhatThePriorExcludesIsNoRival) {
  VERIFIES("LASSO-REG-026~2 LASSO-REG-027~1");
  scan();
  for (const double sigma_rad : {0.0, 0.03}) {
    const HitSolution near = registered(truth());
    const LineSearch search = searched(prior(truth(), sigma_rad), near);
    EXPECT_EQ(search.rivals.size(), 0u) << sigma_rad;
    EXPECT_EQ(search.rival_m, 0);
    EXPECT_FALSE(search.contradicted);
    EXPECT_EQ(search.best.T_target_sensor.p, near.T_target_sensor.p);
    EXPECT_EQ(with_rivals(search, near.H), near.H);
  }
}

TEST_F(BeamTest, ARivalIsLookedForAgainAlthoughThePriorHasForgottenIt) {
  VERIFIES("LASSO-REG-027~1");
  scan();
  PriorPose known = prior(truth(), 0.01);
  known.rival_m = 2 * mission_.radius_m;
  EXPECT_GT(searched(known, registered(truth())).rivals.size(), 0u);
}

TEST_F(BeamTest, NoPlaceIsTriedBeyondHalfATurn) {
  VERIFIES("LASSO-REG-026~2");
  scan();
  PriorPose known = prior(truth(), 0.01);
  for (const double rival_m : {10 * mission_.radius_m, 1e300, std::numeric_limits<double>::infinity()}) {
    known.rival_m = rival_m;
    const LineSearch search = searched(known, registered(truth()));
    ASSERT_TRUE(std::isfinite(search.best.T_target_sensor.p.norm())) << rival_m;
    ASSERT_GT(search.rivals.size(), 0u) << rival_m << ": places are as close as a basin is wide";
    for (const Pose& rival : search.rivals) EXPECT_LT(rival.p.norm(), 2 * truth().p.norm()) << rival_m;
  }
}

// A beam that is longer than the field says nothing of its place along itself. That hides nothing of its turn.
TEST_F(BeamTest, BesideAnAxisThatNothingTellsTheNextIsLookedAt) {
  VERIFIES("LASSO-REG-026~2 LASSO-REG-027~1");
  scan();
  keep_points([this](std::size_t, const MatchPoint<FlightNumber>& point) {
    const Vec3 p(FlightNumber::to_double(point.p[0]), FlightNumber::to_double(point.p[1]), FlightNumber::to_double(point.p[2]));
    return std::abs((truth() * p)[0]) < 0.25;
  });
  const HitSolution near = registered(truth());
  Directions unseen;
  (void)covariance_of_hits(mission_.radius_m, near.H, 1, unseen);
  ASSERT_EQ(unseen.count, 1);
  PriorPose known = prior(truth(), 0.4);
  known.covariance(3, 3) = 100;
  const LineSearch search = searched(known, near);
  ASSERT_GT(search.rivals.size(), 0u);
  EXPECT_GT(std::abs(turn_of(search.rivals[0]) - turn_of(search.best.T_target_sensor)), 0.9 * kQuarterTurn_rad);
}

TEST_F(BeamTest, WithoutAPriorOrAnAxisThePoseStays) {
  VERIFIES("LASSO-REG-026~2");
  scan();
  const HitSolution near = registered(truth());
  EXPECT_EQ(searched({truth()}, near).rivals.size(), 0u);
  keep_first_points(3);
  const HitSolution nothing = registered(truth());
  ASSERT_EQ(nothing.stop, StopReason::kTooFewPoints);
  EXPECT_EQ(searched(prior(truth(), 0.4), nothing).best.stop, StopReason::kTooFewPoints);
}

TEST_F(PeggedBeamTest, AWrongMinimumGivesPlaceToTheRightOne) {
  VERIFIES("LASSO-REG-026~2");
  scan();
  const HitSolution wrong = registered(turned(kQuarterTurn_rad));
  ASSERT_GT(std::abs(turn_of(wrong.T_target_sensor)), 1);
  const LineSearch search = searched(prior(turned(kQuarterTurn_rad), 0.4), wrong);
  EXPECT_LT(std::abs(turn_of(search.best.T_target_sensor)), 0.02);
  EXPECT_EQ(search.rivals.size(), 0u);
  EXPECT_FALSE(search.contradicted);
}

// Its place is known to a millimetre, and off by two centimetres: nothing that the scan shows is likely.
TEST_F(PeggedBeamTest, APoseThatThePriorExcludesIsNotTakenButContradicts) {
  VERIFIES("LASSO-REG-028~1");
  scan();
  const HitSolution wrong = registered(turned(kQuarterTurn_rad));
  PriorPose known = prior(wrong.T_target_sensor, 0.4);
  known.T_target_sensor.p += Vec3(0, 0.02, 0);
  const LineSearch search = searched(known, wrong);
  EXPECT_TRUE(search.contradicted);
  EXPECT_EQ(search.best.T_target_sensor.p, wrong.T_target_sensor.p);
  EXPECT_EQ(search.rivals.size(), 0u);
}

TEST_F(PeggedBeamTest, APoseThatIsContradictedIsNotValid) {
  VERIFIES("LASSO-REG-028~1");
  parameters().agreement_min = 0;  // or its rays would tell already
  const auto image = test::scan_box(scan_, random_);
  const auto estimator = std::make_unique<Estimator>();
  StartPoint start{inverse(turned(kQuarterTurn_rad)), Twist{}};
  EXPECT_EQ(estimator->estimate(mission_, *image, start).reason, PoseReason::kValid) << "alone it explains the scan";
  start.T_sensor_target.p += Vec3(0.006, -0.006, 0);
  start.covariance = 1e-6 * Mat6::Identity();
  start.covariance.topLeftCorner<3, 3>() = 0.16 * Mat3::Identity();
  const Registration result = estimator->estimate(mission_, *image, start);
  EXPECT_EQ(result.reason, PoseReason::kImplausible) << turn_of(inverse(result.T_sensor_target));
  start.T_sensor_target = scan_.T_sensor_target;
  EXPECT_EQ(estimator->estimate(mission_, *image, start).reason, PoseReason::kValid);
}

// Sigmas that are too small by a known factor, of axes that the hits show.
class WidenTest : public BeamTest {
 protected:
  WidenTest() {
    scan_.sigma_m = 0.02;
    parameters().sigma0_m = 0.02;
    scan_.side = 16;
  }
  Mat6 honest(const HitSolution& hits) {
    Directions unseen;
    return covariance_of_hits(mission_.radius_m, hits.H, 1, unseen);
  }
  Vec6 axis_sigmas_m(const Mat6& covariance) const {
    const Vec6 scale = radius_scale(mission_.radius_m);
    return eigen6(scale.asDiagonal() * covariance * scale.asDiagonal()).values.cwiseSqrt();
  }
  Mat6 widened(const HitSolution& hits, const Mat6& covariance, Directions& unseen) {
    Mat6 wide = covariance;
    widen_weak_axes(mission_, hits, 1, *workspace_, wide, unseen);
    return wide;
  }
};

TEST_F(WidenTest, AnHonestCovarianceStays) {
  VERIFIES("LASSO-REG-025~1");
  scan();
  const HitSolution hits = registered(truth());
  Directions unseen;
  const Mat6 covariance = honest(hits);
  ASSERT_GT(axis_sigmas_m(covariance)[5], 0.002 * mission_.radius_m);
  const Vec6 before = axis_sigmas_m(covariance);
  const Vec6 after = axis_sigmas_m(widened(hits, covariance, unseen));
  for (int i = 0; i < 6; ++i) EXPECT_LT(after[i], 2.01 * before[i]) << i;
  EXPECT_NEAR(after[5], before[5], 1e-9);
  EXPECT_EQ(unseen.count, 0);
}

// The cost rises with the square: a sigma that is short by f > 5/4 is doubled until it is short by less.
TEST_F(WidenTest, ASigmaThatIsTooSmallIsDoubledUntilTheCostRises) {
  VERIFIES("LASSO-REG-025~1");
  scan();
  const HitSolution hits = registered(truth());
  const Mat6 covariance = honest(hits);
  const double sigma_m = axis_sigmas_m(covariance)[5];
  for (const double factor : {2.0, 4.0, 6.0}) {
    if (sigma_m / factor < 0.0021 * mission_.radius_m) continue;
    Directions unseen;
    const double found_m = axis_sigmas_m(widened(hits, covariance / (factor * factor), unseen))[5];
    EXPECT_GT(found_m, 0.7 * sigma_m) << factor;
    EXPECT_LT(found_m, 2.1 * sigma_m) << factor;
    EXPECT_EQ(unseen.count, 0);
  }
}

TEST_F(WidenTest, AnAxisAlongWhichNothingRisesIsUnseen) {
  VERIFIES("LASSO-REG-025~1");
  scan();
  HitSolution hits = registered(truth());
  hits.usable = 0;  // no return counts: the cost is the same everywhere
  Directions unseen;
  const Mat6 covariance = honest(hits);
  const Mat6 wide = widened(hits, covariance, unseen);
  ASSERT_GT(unseen.count, 0);
  EXPECT_NEAR(axis_sigmas_m(wide)[5], kUnseenSigma * mission_.radius_m, 1e-3 * mission_.radius_m);
}

TEST_F(WidenTest, AxesThatAreCertainAreNotTried) {
  VERIFIES("LASSO-REG-025~1");
  scan();
  HitSolution hits = registered(truth());
  hits.usable = 0;
  Directions unseen;
  const Mat6 certain = 1e-8 * Mat6::Identity();
  EXPECT_EQ(widened(hits, certain, unseen), certain);
}

}  // namespace
}  // namespace lasso
