#include "fsw/pose/registration/profile.hpp"

#include <cmath>
#include <limits>

#include "ut/pose/beam_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

const Vec6 kTurn = Vec6::Unit(0);  // about the beam

// Noise as large as the parts that tell the turn: costs are smooth over what it leaves open.
class ProfileTest : public test::PeggedBeamTest {
 protected:
  ProfileTest() { set_noise(0.01); }
  void set_noise(double sigma_m) { scan_.sigma_m = parameters().sigma0_m = sigma_m; }
  Profile profile() { return {mission_, kTurn, static_cast<double>(workspace_->points.size()), *workspace_}; }
  double radius_m() const { return mission_.radius_m; }

  // Of turns by whole steps, each drawn from the truth until nothing moves any more: the one that costs least.
  CostedPose best_of_grid(double step_rad, int steps) {
    Profile costs = profile();
    CostedPose best{truth(), std::numeric_limits<double>::infinity()};
    for (int i = -steps; i <= steps; ++i) {
      const CostedPose next = costs.draw_at(turned(i * step_rad), 0, 8);
      if (next.cost < best.cost) best = next;
    }
    return best;
  }
};

TEST_F(ProfileTest, APoseIsDrawnToTheHitsWithItsAxisHeld) {
  VERIFIES("LASSO-REG-031~2");
  set_noise(1e-3);
  scan();
  Pose off = turned(0.02);
  off.p += Vec3(4e-3, -3e-3, 2e-3);
  const CostedPose here = profile().draw_at(off, 0, 2);
  EXPECT_NEAR(turn_of(here.T_target_sensor), 0.02, 1e-3);
  EXPECT_LT((here.T_target_sensor.p - turned(0.02).p).tail<2>().norm(), 2e-3) << "along itself a beam is hardly held";
  const CostedPose farther = profile().draw_at(off, 0.05 * radius_m(), 2);
  EXPECT_NEAR(turn_of(farther.T_target_sensor), 0.07, 2e-3) << "metres are those at the model's radius";
  EXPECT_EQ(farther.cost, profile().cost_at(farther.T_target_sensor).cost);
}

TEST_F(ProfileTest, DescendsToTheTurnThatAGridFinds) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  const CostedPose best = best_of_grid(1e-3, 60);
  for (const double off_rad : {-0.11, -0.04, 0.013, 0.06, 0.14}) {
    Profile along = profile();
    const CostedPose found = along.descend(along.cost_at(turned(off_rad)), 0.02 * radius_m());
    EXPECT_LT(found.cost, best.cost + kMostOfAReturn) << off_rad;
    EXPECT_NEAR(turn_of(found.T_target_sensor), turn_of(best.T_target_sensor), 0.02) << off_rad;
  }
}

TEST_F(ProfileTest, StepsEndAtHalfOfTheRadius) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  Profile along = profile();
  const CostedPose found = along.descend(along.cost_at(turned(-0.72)), 0.06 * radius_m());
  const double gone_rad = turn_of(found.T_target_sensor) + 0.72;
  EXPECT_GT(gone_rad, 0.42 - 0.02) << "0.06, twice and four times as far";
  EXPECT_LT(gone_rad, 0.42 + 0.18 + 0.02) << "the last step is halved twice";
}

// Near a minimum without residuals the cost rises with the square of the way, as the information says.
TEST_F(ProfileTest, CostsRiseAsTheInformationSays) {
  VERIFIES("LASSO-REG-025~3");
  scan_.sigma_m = 1e-5;
  scan();
  const HitSolution hits = registered(truth());
  const double sigma_m = radius_m() / std::sqrt(hits.H(0, 0));
  Profile along(mission_, kTurn, hits.usable, *workspace_);
  const CostedPose here = along.cost_at(hits.T_target_sensor);
  for (const double sigmas : {3.0, 5.0}) {
    EXPECT_TRUE(along.rises(here, sigmas * sigma_m, 0.85 * sigmas * sigmas)) << sigmas;
    EXPECT_FALSE(along.rises(here, sigmas * sigma_m, 1.05 * sigmas * sigmas)) << sigmas;
  }
}

TEST_F(ProfileTest, AMinimumStays) {
  VERIFIES("LASSO-REG-031~2");
  for (int i = 0; i < 4; ++i) {
    scan();
    HitSolution hits = registered(truth());
    const HitSolution before = hits;
    EXPECT_FALSE(minimise_along(mission_, kTurn, 0.02 * radius_m(), truth(), *workspace_, hits).moved);
    EXPECT_EQ(hits.T_target_sensor.p, before.T_target_sensor.p);
    EXPECT_EQ(hits.H, before.H);
  }
}

TEST_F(ProfileTest, APoseBesideAMinimumIsMovedIntoIt) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  const CostedPose best = best_of_grid(1e-3, 60);
  HitSolution hits = weigh_hits(mission_, turned(0.1), *workspace_);
  hits.iterations = 7;
  hits.stop = StopReason::kIterationLimit;
  ASSERT_TRUE(minimise_along(mission_, kTurn, 0.02 * radius_m(), turned(0.13), *workspace_, hits).moved);
  EXPECT_NEAR(turn_of(hits.T_target_sensor), turn_of(best.T_target_sensor), 0.02);
  EXPECT_EQ(hits.stop, StopReason::kIterationLimit) << "the registration did not end";
  EXPECT_EQ(hits.iterations, 7);
  const HitSolution weighed = weigh_hits(mission_, hits.T_target_sensor, *workspace_);
  EXPECT_EQ(hits.H, weighed.H) << "the information is that of the pose it is given with";
}

// Of 13 returns 11 lie on the model at the truth, and all are inliers, far off, half a kernel beside it. Of 11 there is no solution.
TEST_F(ProfileTest, APlaceWithoutASolutionIsNotMovedTo) {
  VERIFIES("LASSO-REG-031~2");
  set_noise(1e-3);
  scan_.sigma_m = 0;
  scan();
  keep_first_points(13);
  for (std::size_t i = 11; i < 13; ++i) {
    MatchPoint<FlightNumber>& point = workspace_->points[i];
    for (int k = 0; k < 3; ++k) {
      const double moved = FlightNumber::to_double(point.p[k]) + 0.012 * FlightNumber::to_double(point.u[k]);
      point.p[k] = FlightNumber::to_length(moved);
    }
  }
  Pose nearer = scan_.T_sensor_target;
  nearer.p[2] += 0.006;
  HitSolution hits = weigh_hits(mission_, inverse(nearer), *workspace_);
  ASSERT_EQ(hits.inliers, 13u);
  ASSERT_EQ(weigh_hits(mission_, truth(), *workspace_).stop, StopReason::kTooFewPoints);
  ASSERT_LT(profile().cost_at(truth()).cost, profile().cost_at(inverse(nearer)).cost - kMostOfAReturn);
  EXPECT_FALSE(minimise_along(mission_, kTurn, 0.02 * radius_m(), truth(), *workspace_, hits).moved);
  EXPECT_EQ(hits.inliers, 13u);
}

TEST_F(ProfileTest, APredictionThatCostsLessTakesThePlaceOfTheRegistration) {
  VERIFIES("LASSO-REG-031~2");
  set_noise(1e-3);
  scan();
  const HitSolution wrong = registered(turned(test::kQuarterTurn_rad));
  ASSERT_GT(std::abs(turn_of(wrong.T_target_sensor)), 1) << "a minimum of its own";
  HitSolution hits = wrong;
  EXPECT_FALSE(minimise_along(mission_, kTurn, 0.02 * radius_m(), wrong.T_target_sensor, *workspace_, hits).moved);
  ASSERT_TRUE(minimise_along(mission_, kTurn, 0.02 * radius_m(), turned(0.002), *workspace_, hits).moved);
  EXPECT_LT(std::abs(turn_of(hits.T_target_sensor)), 0.02);
  EXPECT_FALSE(minimise_along(mission_, kTurn, 0.02 * radius_m(), wrong.T_target_sensor, *workspace_, hits).moved) << "but not otherwise";
}

}  // namespace
}  // namespace lasso
