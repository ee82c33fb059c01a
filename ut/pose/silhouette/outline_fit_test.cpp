#include "fsw/pose/silhouette/outline_fit.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kSigma_m = 1e-3;
constexpr double kGate_m = 0.01;
constexpr double kLastStep = 0.002;

// The box's top face, seen straight on: its plane holds neither the shifts in it nor the turn about its normal.
class OutlineTest : public test::PoseFixture {
 protected:
  OutlineTest() {
    scan_.T_sensor_target.q = exp_so3(Vec3(0, 0, 0.4));
    scan_.T_sensor_target.p = Vec3(0.03, -0.02, 2.5);
    in_plane_.count = 3;
    in_plane_.vectors(2, 0) = in_plane_.vectors(3, 1) = in_plane_.vectors(4, 2) = 1;
  }

  // A step along the three of them, target axes.
  Pose beside(double turn_rad, double x_m, double y_m) const {
    Vec6 step = Vec6::Zero();
    step[2] = turn_rad;
    step[3] = x_m;
    step[4] = y_m;
    return step_pose(truth(), step);
  }

  OutlineFit fit(const Pose& start) { return fit_outline(mission_, start, in_plane_, care_, *workspace_); }

  // A ray that was asked last, and what it meets, by the box's closed form.
  struct Met {
    bool hit;      // as it was scanned
    bool surface;  // the pose has one there
    double gap_m;  // between them, where both are
  };
  Met meet(const OutlineRay& asked, const Pose& T_target_sensor) const {
    const ScanRay<FlightNumber>& ray = workspace_->rays[asked.ray];
    const Vec3 u(FlightNumber::to_double(ray.u[0]), FlightNumber::to_double(ray.u[1]), FlightNumber::to_double(ray.u[2]));
    const double met_m = cast_box(scan_.model, T_target_sensor.p, rotate(T_target_sensor.q, u));
    return {ray.state == RayState::kHit, met_m > 0, std::abs(met_m - FlightNumber::to_double(ray.range))};
  }

  std::uint32_t count_disputed(const Pose& T_target_sensor) const {
    std::uint32_t count = 0;
    for (const OutlineRay& asked : workspace_->outline) {
      const Met met = meet(asked, T_target_sensor);
      count += met.hit != met.surface || (met.hit && met.gap_m >= kGate_m) ? 1U : 0U;
    }
    return count;
  }

  // Quarters of a ray: a gap's square in parts of three sigmas', or a whole ray.
  std::uint32_t cost_of(const Pose& T_target_sensor) const {
    std::uint32_t cost = 0;
    for (const OutlineRay& asked : workspace_->outline) {
      const Met met = meet(asked, T_target_sensor);
      const double share = met.gap_m / (3 * kSigma_m);
      if (met.hit != met.surface) cost += 4;
      if (met.hit && met.surface) cost += static_cast<std::uint32_t>(std::min(4.0, std::floor(4 * share * share)));
    }
    return cost;
  }

  std::uint32_t count_hits() const {
    std::uint32_t count = 0;
    for (const OutlineRay& asked : workspace_->outline) count += workspace_->rays[asked.ray].state == RayState::kHit ? 1U : 0U;
    return count;
  }

  // Steps go along one direction at a time, and can end where none of them helps: many rays then still dispute the pose.
  bool is_brought_back(const Pose& start) {
    const OutlineFit found = fit(start);
    if (found.disputed > 4) return false;
    EXPECT_LT(found.within_m.head<3>().maxCoeff(), 0.2);
    const Vec6 error = error_of(found.T_target_sensor);
    EXPECT_LT(error.head<3>().norm() * mission_.radius_m, 0.08);
    EXPECT_LT(error.tail<3>().norm(), 0.05);
    return true;
  }

  Directions in_plane_;
  OutlineCare care_{kSigma_m, kGate_m - 6 * kSigma_m, 100000, 100000, 0.06, kLastStep};
};

TEST_F(OutlineTest, APoseThatSlidIsBroughtBackToWithinARaysSpacing) {
  VERIFIES("LASSO-REG-022~3");
  scan_.sigma_m = 1e-3;
  scan_.side = 32;  // a ray every 26 mm
  scan();
  int count = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 x = test::random_vec3(random_, 1);
    count += is_brought_back(beside(0.1 * x[0], 0.1 * x[1], 0.1 * x[2])) ? 1 : 0;
  }
  EXPECT_GE(count, 30);
  EXPECT_TRUE(is_brought_back(beside(0, 0.3, 0)));  // farther than the longest step at once
}

// A step that was tried last, between the last one and twice that, and helped no more.
TEST_F(OutlineTest, WhereItEndsNoShortStepCostsARayLess) {
  VERIFIES("LASSO-REG-022~3");
  scan_.sigma_m = kSigma_m;
  const double step_m = 0.06 / 16 * mission_.radius_m;
  ASSERT_GE(step_m, kLastStep * mission_.radius_m);
  int ends = 0;
  for (int k = 0; k < 20; ++k) {
    scan();
    const Vec3 x = test::random_vec3(random_, 0.06);
    const Pose start = beside(x[0], x[1], x[2]);
    const OutlineFit found = fit(start);
    if (!found.moved) continue;
    ++ends;
    const std::uint32_t cost = cost_of(found.T_target_sensor);
    EXPECT_LE(cost + 4 * kFewRays, cost_of(start) + 2);
    for (int i = 0; i < 3; ++i) {
      for (const double way : {-1.0, 1.0}) {
        const Vec6 off = in_plane_.vectors.col(i).cwiseQuotient(radius_scale(mission_.radius_m)) * way * step_m;
        EXPECT_GT(cost_of(step_pose(found.T_target_sensor, off)) + 4 + 4, cost) << i << way;  // a ray along an edge may be rounded
      }
    }
  }
  EXPECT_GT(ends, 12);
}

// With what an estimate may ask, and may ask again from where the first one ended.
TEST_F(OutlineTest, AnEstimatesQuestionsBringMostPosesBack) {
  VERIFIES("LASSO-REG-022~3");
  scan_.sigma_m = kSigma_m;
  int count = 0;
  for (int i = 0; i < 60; ++i) {
    scan();
    const Vec3 x = test::random_vec3(random_, 1);
    const Pose start = beside(0.05 * x[0], 0.06 * x[1], 0.06 * x[2]);
    care_ = {kSigma_m, kGate_m - 6 * kSigma_m, kMostAsked};
    const OutlineFit near = fit(start);
    EXPECT_LE(near.asked, kMostAsked + care_.measured + 15 * kOutlineRays);
    care_.asked = kMostAskedAgain;
    const OutlineFit found = fit(near.T_target_sensor);
    EXPECT_LE(found.asked, kMostAskedAgain + care_.measured + 15 * kOutlineRays);
    if (!found.settled) continue;
    ++count;
    EXPECT_LT(error_of(found.T_target_sensor).tail<3>().norm(), 0.06) << i;
  }
  EXPECT_GT(count, 30);
}

TEST_F(OutlineTest, RaysDisputeAPoseAsTheClosedFormHasIt) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 22;
  scan_.dropouts = 0.02;
  scan_.outliers = 0.02;
  in_plane_.count = 0;
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan_.half_angle = 0.12;
    scan();
    const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.1, 0.05, random_));
    const OutlineFit found = fit(start);
    EXPECT_EQ(found.rays, workspace_->outline.size());
    EXPECT_EQ(found.hits, count_hits());
    EXPECT_NEAR(found.disputed, count_disputed(start), 2);  // a ray along an edge may be rounded to either side
    EXPECT_GT(found.disputed, 10U);
    EXPECT_FALSE(found.moved);
    EXPECT_EQ(found.T_target_sensor.p, start.p) << "there is no direction to go";
  }
}

TEST_F(OutlineTest, AMoveIsWorthMoreThanAPatternsChance) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 22;
  scan_.sigma_m = kSigma_m;
  int moves = 0;
  for (int i = 0; i < 30; ++i) {
    scan();
    const Vec3 x = test::random_vec3(random_, 0.015);
    const Pose start = beside(x[0], x[1], x[2]);
    const OutlineFit found = fit(start);
    EXPECT_NEAR(found.disputed, count_disputed(found.T_target_sensor), 2);
    if (found.moved) {
      EXPECT_LE(found.disputed + kFewRays, count_disputed(start) + 1);
      ++moves;
    } else {
      EXPECT_EQ(found.T_target_sensor.p, start.p);
      EXPECT_LT(count_disputed(start), 12U);
    }
  }
  EXPECT_GT(moves, 5);
  EXPECT_LT(moves, 29);
}

// Rays dispute a height over the face only beyond the gate; its hits know it to a fraction of their noise.
TEST_F(OutlineTest, WhatTheHitsHoldIsNotMoved) {
  VERIFIES("LASSO-REG-022~3");
  scan_.sigma_m = kSigma_m;
  in_plane_.count = 4;
  in_plane_.vectors(5, 3) = 1;
  for (int i = 0; i < 10; ++i) {
    scan();
    const OutlineFit found = fit(beside(0.03, 0.05, -0.04));
    EXPECT_TRUE(found.moved);
    EXPECT_LT(std::abs((found.T_target_sensor.p - truth().p)[2]), 1.5 * kSigma_m);
  }
}

// What the hits see is theirs to say: here no ray disputes the pose for it.
TEST_F(OutlineTest, WithoutDisputesThereIsNoMove) {
  VERIFIES("LASSO-REG-022~3");
  scan_.sigma_m = 1e-4;
  scan();
  in_plane_.count = 1;
  in_plane_.vectors = Mat6::Zero();
  in_plane_.vectors(5, 0) = 1;
  care_.first_step = 0.004;
  Pose start = truth();
  start.p[2] += 3e-3;
  const OutlineFit found = fit(start);
  EXPECT_FALSE(found.moved);
  EXPECT_EQ(found.T_target_sensor.p, start.p);
}

TEST_F(OutlineTest, WhatMayNotBeMeasuredIsNotSaid) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 40;
  scan();
  int said[2] = {};
  for (int i = 0; i < 25; ++i) {
    const Vec3 x = test::random_vec3(random_, 0.06);
    for (int k = 0; k < 2; ++k) {
      care_.measured = k == 0 ? 0 : 100000;
      const OutlineFit found = fit(beside(x[0], x[1], x[2]));
      for (int j = 0; j < 3; ++j) said[k] += found.within_m[j] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(said[0], 0);
  EXPECT_LT(said[0], said[1]);
}

// Off by as much as it says, more rays do dispute the pose.
TEST_F(OutlineTest, FartherOffThanItSaysMoreRaysDisputeThePose) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 40;
  scan();
  int said = 0;
  for (int k = 0; k < 10; ++k) {
    const Vec3 x = test::random_vec3(random_, 0.02);
    const OutlineFit found = fit(beside(x[0], x[1], x[2]));
    for (int i = 0; i < 3; ++i) {
      if (!(found.within_m[i] > 0)) continue;
      ++said;
      for (const double way : {-1.0, 1.0}) {
        const Vec6 off = in_plane_.vectors.col(i).cwiseQuotient(radius_scale(mission_.radius_m)) * way * found.within_m[i];
        EXPECT_GE(count_disputed(step_pose(found.T_target_sensor, off)), found.disputed + kFewRays - 1) << i << way;
      }
    }
  }
  EXPECT_GT(said, 15);
}

TEST_F(OutlineTest, WhereNoRayPassesByItSaysNothing) {
  VERIFIES("LASSO-REG-023~1");
  scan_.half_angle = 0.04;  // all rays meet the face, far from its rim
  scan();
  const OutlineFit found = fit(truth());
  EXPECT_EQ(found.hits, found.rays);
  EXPECT_EQ(found.disputed, 0U);
  EXPECT_EQ(found.within_m, Vec6(Vec6::Zero()));
}

TEST_F(OutlineTest, ThePoseMovesInTheGivenDirectionsOnly) {
  VERIFIES("LASSO-REG-022~3");
  scan();
  in_plane_.count = 1;
  in_plane_.vectors = Mat6::Zero();
  in_plane_.vectors(3, 0) = 1;
  const Pose start = beside(0.02, 0.08, 0.03);
  const OutlineFit found = fit(start);
  ASSERT_TRUE(found.moved);
  EXPECT_LT(std::abs(found.T_target_sensor.p[0] - beside(0.02, 0, 0.03).p[0]), 0.03);
  EXPECT_EQ(found.T_target_sensor.p[1], start.p[1]);
  EXPECT_EQ(found.T_target_sensor.p[2], start.p[2]);
  EXPECT_LT(found.T_target_sensor.q.angularDistance(start.q), 1e-12);
}

// Near at the time at which the ray was cast, by the target's motion: as few are cast here that each of them has room.
TEST_F(OutlineTest, TheRaysThatPassNearTheTargetAreAsked) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 4;
  const double reach_m = 1.5 * mission_.radius_m;
  int differ = 0;
  for (int k = 0; k < 40; ++k) {
    scan_.half_angle = random_.uniform(0.15, 0.35);
    scan_.rates.v_mps = test::random_vec3(random_, 0.6);
    scan_.rates.omega_radps = test::random_vec3(random_, 0.3);
    scan();
    (void)fit(truth());
    std::size_t next = 0;
    for (std::size_t i = 0; i < image_->samples.size(); ++i) {
      const RangeSample& sample = image_->samples[i];
      const Vec3 u = to_vec3(sample.direction).normalized();
      const double dt_s = to_seconds(sample.t_us - image_->reference_time_us());
      const double passes_m = (propagate(scan_.T_sensor_target, scan_.rates, dt_s) * mission_.center_m).cross(u).norm();
      const double at_rest_m = (scan_.T_sensor_target * mission_.center_m).cross(u).norm();
      const bool is_asked = next < workspace_->outline.size() && workspace_->outline[next].ray == i;
      next += is_asked ? 1 : 0;
      if (std::abs(passes_m - reach_m) < 1e-3) continue;  // the motion is moved back to first order
      EXPECT_EQ(is_asked, passes_m < reach_m) << i << " passes at " << passes_m;
      differ += (passes_m < reach_m) != (at_rest_m < reach_m) ? 1 : 0;
    }
  }
  EXPECT_GT(differ, 10);
}

TEST_F(OutlineTest, OfMoreRaysThanThereIsRoomForSomeAreAsked) {
  VERIFIES("LASSO-REG-022~3");
  scan_.side = 63;
  scan();
  const OutlineFit found = fit(beside(0.05, 0.05, -0.08));
  EXPECT_LE(found.rays, kOutlineRays);
  EXPECT_GT(found.rays, kOutlineRays / 2);
  EXPECT_LT(error_of(found.T_target_sensor).tail<3>().norm(), 0.025);
}

TEST_F(OutlineTest, ItAsksNoMoreThanItMay) {
  VERIFIES("LASSO-REG-022~3");
  scan();
  const Pose start = beside(0.08, 0.07, -0.07);
  const OutlineFit whole = fit(start);
  for (const std::uint32_t asked : {0U, 500U, 2000U, 4000U}) {
    care_.asked = asked;
    care_.measured = 0;
    const OutlineFit found = fit(start);
    EXPECT_LE(found.asked, asked + 15 * kOutlineRays);
    EXPECT_NEAR(found.disputed, count_disputed(found.T_target_sensor), 1) << "all are asked in the end";
    EXPECT_LT(found.asked, whole.asked);
  }
  care_.asked = 0;
  EXPECT_EQ(fit(start).T_target_sensor.p, start.p);
}

TEST_F(OutlineTest, AnOutlineThatManyRaysDisputeSettlesNothing) {
  VERIFIES("LASSO-REG-022~3");
  scan_.dropouts = 0.2;
  scan();
  const OutlineFit disputed = fit(truth());
  EXPECT_FALSE(disputed.settled);
  EXPECT_EQ(disputed.within_m, Vec6(Vec6::Zero()));
  parameters().dropout_probability = 0.2;
  int settled = 0;
  for (int i = 0; i < 20; ++i) {
    scan();
    settled += fit(truth()).settled ? 1 : 0;
  }
  EXPECT_GE(settled, 18);
}

TEST_F(OutlineTest, AnEndlessSearchEndsAndNoRaysMoveNothing) {
  VERIFIES("LASSO-REG-022~3");
  scan();
  care_.last_step = 0;
  EXPECT_LE(fit(beside(0.02, 0.01, 0.01)).disputed, 4U);
  workspace_->rays.clear();
  const OutlineFit nothing = fit(truth());
  EXPECT_EQ(nothing.rays, 0U);
  EXPECT_EQ(nothing.disputed, 0U);
  EXPECT_EQ(nothing.T_target_sensor.p, truth().p);
}

}  // namespace
}  // namespace lasso
