#include "fsw/pose/registration/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/pose/estimator/estimator.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class AgreementTest : public test::PoseFixture {
 protected:
  // Range of the box along a ray of the workspace, in closed form; below 0 where it is missed.
  double cast(const ScanRay<N>& ray, const Pose& T_target_sensor, const Vec3& beside = Vec3::Zero()) const {
    Vec3 o;
    Vec3 u;
    for (int i = 0; i < 3; ++i) {
      o[i] = N::to_double(ray.o[i]) + beside[i];
      u[i] = N::to_double(ray.u[i]);
    }
    return test::cast_box(scan_.model, T_target_sensor * o, rotate(T_target_sensor.q, u));
  }

  double agreement(const Pose& T_target_sensor, const PoseDoubt& doubt = {}, bool misses_known = true) const {
    return agreement_of_rays(mission_, Expectation(mission_, T_target_sensor, doubt), misses_known, *workspace_);
  }

  // By brute force, without doubt: returns off by more than five sigmas, and misses that should have hit.
  void count_odd(const Pose& T_target_sensor, int& returns, int& misses) const {
    returns = misses = 0;
    for (const ScanRay<N>& ray : workspace_->rays) {
      const double range_m = cast(ray, T_target_sensor);
      if (ray.state == RayState::kMiss) {
        misses += range_m > 0 ? 1 : 0;
      } else {
        returns += range_m > 0 && std::abs(range_m - N::to_double(ray.range)) <= 5 * mission_.parameters.sigma0_m ? 0 : 1;
      }
    }
  }

  // Turns every `n`-th return into what `change` makes of it; says how many.
  template <class Change>
  int spoil(std::size_t n, Change change) {
    std::size_t index = 0;
    int spoiled = 0;
    for (ScanRay<N>& ray : workspace_->rays) {
      if (ray.state != RayState::kHit || index++ % n != 0) continue;
      change(ray);
      ++spoiled;
    }
    return spoiled;
  }
  // So many rays contradict.
  double with_odd(double odd) const { return 1 - std::max(0.0, odd - 2) / returns(); }
  double returns() const { return static_cast<double>(workspace_->points.size()); }
};

// The grid of the box's field is exact but for rounding, so that rays within it of an edge may differ from the closed form.
TEST_F(AgreementTest, IsOneLessTheShareOfContradictingRaysOverTheReturns) {
  VERIFIES("LASSO-REG-029~2");
  scan_.side = 20;
  scan_.sigma_m = 1e-3;
  parameters().incidence_max_rad = 1.5707;
  parameters().surface_sigma_m = 0;
  scan_.rates.v_mps = Vec3(0.3, -0.2, 0.5);  // rays with an origin of their own
  int compared = 0;
  for (int i = 0; i < 30; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    if (workspace_->points.size() < 20) continue;
    const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.08, 0.02, random_));
    int odd_returns = 0;
    int odd_misses = 0;
    count_odd(pose, odd_returns, odd_misses);
    EXPECT_NEAR(agreement(pose), std::max(0.0, with_odd(odd_returns + odd_misses)), 1.001 / returns());
    EXPECT_NEAR(agreement(pose, {}, false), std::max(0.0, with_odd(odd_returns)), 1.001 / returns());
    compared += odd_returns > 3 && odd_misses > 3 ? 1 : 0;
  }
  EXPECT_GT(compared, 10);
}

TEST_F(AgreementTest, ItIsOneAtTheTruthWithNoise) {
  VERIFIES("LASSO-REG-029~2");
  scan_.sigma_m = 1e-3;
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const PoseDoubt doubt{1e-8 * Mat6::Identity()};
    EXPECT_EQ(agreement(truth(), doubt), 1);
  }
}

TEST_F(AgreementTest, ReturnsInFrontOfTheTargetAndFromBehindItsSurfaceContradict) {
  VERIFIES("LASSO-REG-029~2");
  for (const double change_m : {-0.2, -0.0055, 0.0055, 0.2}) {
    scan();
    const int odd = spoil(9, [change_m](ScanRay<N>& ray) { ray.range += N::to_length(change_m); });
    EXPECT_NEAR(agreement(truth()), with_odd(odd), 1e-9) << change_m;
  }
  scan();
  (void)spoil(9, [](ScanRay<N>& ray) { ray.range += N::to_length(0.0045); });
  EXPECT_EQ(agreement(truth()), 1) << "within five sigmas";
  (void)spoil(9, [](ScanRay<N>& ray) { ray.range += N::to_length(0.005); });
  EXPECT_LT(agreement(truth()), 1);
  EXPECT_EQ(agreement(truth(), {Mat6::Zero(), 4, 0}), 1) << "of the noise that residuals show";
}

TEST_F(AgreementTest, MissesContradictButForDropouts) {
  VERIFIES("LASSO-REG-029~2");
  scan_.dropouts = 0.1;
  scan();
  int odd_returns = 0;
  int odd_misses = 0;
  count_odd(truth(), odd_returns, odd_misses);
  ASSERT_GT(odd_misses, 20);
  EXPECT_NEAR(agreement(truth()), with_odd(odd_misses), 1e-9);
  EXPECT_EQ(agreement(truth(), {}, false), 1) << "of what is not known nothing is concluded";
  parameters().dropout_probability = 0.02;
  const double expected = returns() * 0.02 / 0.98;
  EXPECT_NEAR(agreement(truth()), with_odd(odd_misses - expected - 3 * std::sqrt(expected / 0.98)), 1e-9);
  parameters().dropout_probability = 0.1;
  EXPECT_EQ(agreement(truth()), 1);
}

TEST_F(AgreementTest, WhatTheCovarianceLeavesOpenDoesNotContradict) {
  VERIFIES("LASSO-REG-029~2");
  scan_.side = 14;  // fewer contradict than are excused
  for (int axis = 0; axis < 6; ++axis) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    Vec6 step = Vec6::Zero();
    step[axis] = axis < 3 ? 0.03 / mission_.radius_m : 0.03;
    const Pose off = step_pose(truth(), step);
    PoseDoubt doubt{1e-10 * Mat6::Identity()};
    EXPECT_LT(agreement(off, doubt), 0.98) << axis;
    doubt.covariance(axis, axis) = step[axis] * step[axis] / 4;
    EXPECT_EQ(agreement(off, doubt), 1) << axis << ": it is two sigmas off";
    doubt.covariance(axis, axis) *= 0.5 * 0.5;
    EXPECT_LT(agreement(off, doubt), 0.98) << axis << ": four";
  }
}

// A ray that is wide enough to meet what is beside the edge returns a range between both.
TEST_F(AgreementTest, RangesBetweenTwoSurfacesWithinTheBeamDoNotContradict) {
  VERIFIES("LASSO-REG-029~2");
  scan_.side = 16;
  scan();
  const double beside_m = 0.01;
  double mixed = 0;
  for (ScanRay<N>& ray : workspace_->rays) {
    double nearest_m = 1e9;
    double farthest_m = 0;
    for (const Vec3& side : {Vec3(beside_m, 0, 0), Vec3(-beside_m, 0, 0), Vec3(0, beside_m, 0), Vec3(0, -beside_m, 0)}) {
      const double range_m = cast(ray, truth(), side);
      nearest_m = range_m > 0 && range_m < nearest_m ? range_m : nearest_m;
      farthest_m = range_m > 0 && range_m > farthest_m ? range_m : farthest_m;
    }
    if (ray.state != RayState::kHit || farthest_m - nearest_m < 0.016) continue;
    ray.range = N::to_length(nearest_m);  // of a steep face: 8 mm nearer than its middle
    mixed += 1;
  }
  ASSERT_GT(mixed, 20);
  EXPECT_LT(agreement(truth()), 1 - 0.5 * mixed / returns());
  EXPECT_EQ(agreement(truth(), {Mat6::Zero(), 1, 1.2 * beside_m}), 1) << "the target may have moved so far";
  parameters().sigma_angle_rad = 0.6 * beside_m / 2.5;
  EXPECT_EQ(agreement(truth()), 1) << "within two sigmas of the ray's direction";
}

TEST_F(AgreementTest, AimedReturnsAreNotAsked) {
  VERIFIES("LASSO-REG-029~2");
  scan();
  (void)spoil(2, [](ScanRay<N>& ray) { ray.range += N::to_length(0.1); });
  EXPECT_LT(agreement(truth()), 0.6);
  for (MatchPoint<N>& point : workspace_->points) point.aimed = true;
  EXPECT_EQ(agreement(truth()), 1);
}

TEST_F(AgreementTest, WithoutReturnsNothingAgrees) {
  VERIFIES("LASSO-REG-029~2");
  scan();
  for (ScanRay<N>& ray : workspace_->rays) ray.state = RayState::kMiss;
  EXPECT_EQ(agreement(truth()), 0);
}

TEST_F(AgreementTest, WhatLiesBehindTheSensorOrTooFarIsNotMet) {
  VERIFIES("LASSO-REG-029~2");
  scan();
  Pose behind = scan_.T_sensor_target;
  behind.p = -behind.p;
  Pose far = scan_.T_sensor_target;
  far.p[2] = 3e6 * scan_.model.cell_m;
  for (const Pose& pose : {behind, far}) {
    const Expectation expectation(mission_, inverse(pose), {});
    for (const ScanRay<N>& ray : workspace_->rays) EXPECT_EQ(expectation.is_met_by(ray, 1), ray.state == RayState::kMiss);
  }
}

// Any number of contradicting rays takes a bounded number of walks: some are looked at again, and others taken for like them.
TEST_F(AgreementTest, ManyRaysAreTakenForLikeThoseThatWereLookedAtAgain) {
  VERIFIES("LASSO-REG-029~2");
  scan_.side = 60;
  scan();
  const double all = spoil(3, [](ScanRay<N>& ray) { ray.range += N::to_length(0.1); });
  ASSERT_GT(all, 3 * 64);
  EXPECT_NEAR(agreement(truth()), with_odd(all), 1e-9);
  Vec6 step = Vec6::Zero();
  step[5] = 0.012;
  const PoseDoubt doubt{(step * step.transpose()).eval() / 4 + 1e-12 * Mat6::Identity()};
  scan();
  EXPECT_EQ(agreement(step_pose(truth(), step), doubt), 1) << "all of them are excused";
}

// Three axes that are equally uncertain, and none farther than a tenth of the radius.
TEST_F(AgreementTest, ThreeAxesAreInDoubtAndNoneFarther) {
  VERIFIES("LASSO-REG-029~2");
  scan();
  const double most_m = 0.1 * mission_.radius_m;
  Mat6 covariance = 1e-12 * Mat6::Identity();
  covariance.bottomRightCorner<3, 3>() = Mat3::Identity();
  for (int axis = 3; axis < 6; ++axis) {
    Vec6 step = Vec6::Zero();
    step[axis] = 0.9 * most_m;
    EXPECT_LT(agreement(step_pose(truth(), step)), 0.95) << axis;
    EXPECT_EQ(agreement(step_pose(truth(), step), {covariance}), 1) << axis;
    step[axis] = 2 * most_m;
    EXPECT_LT(agreement(step_pose(truth(), step), {covariance}), 0.95) << axis;
  }
  Vec6 far = Vec6::Zero();
  far[5] = 3 * most_m;
  EXPECT_LT(agreement(step_pose(truth(), far), {Mat6::Zero(), 1, 1}), 0.95) << "nor does motion excuse more";
}

TEST_F(AgreementTest, DropOutsOfAnyShareAreForgivenWhereTheyAreStated) {
  VERIFIES("LASSO-REG-029~2");
  for (const double share : {0.05, 0.3, 0.6}) {
    scan_.dropouts = parameters().dropout_probability = share;
    for (int i = 0; i < 20; ++i) {
      scan();
      EXPECT_GT(agreement(truth()), 0.99) << share;
    }
  }
  for (MatchPoint<N>& point : workspace_->points) point.aimed = true;
  EXPECT_GT(agreement(truth()), 0.99) << "also beside returns that are not asked";
}

TEST_F(AgreementTest, GrazingRaysSayNothing) {
  VERIFIES("LASSO-REG-029~2");
  parameters().incidence_max_rad = 1;  // two of the three faces are seen at less than 33 deg
  scan();
  const Expectation expectation(mission_, truth(), {});
  int grazing = 0;
  for (ScanRay<N>& ray : workspace_->rays) {
    if (ray.state != RayState::kHit) continue;
    const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
    const Vec3 in_box = rotate(truth().q, u);
    const Vec3 place = truth() * Vec3(N::to_double(ray.range) * u) - scan_.model.center;
    int face = 0;
    (place.cwiseAbs() - scan_.model.half).maxCoeff(&face);
    const bool grazes = std::abs(in_box[face]) < std::cos(parameters().incidence_max_rad);
    ray.state = RayState::kMiss;
    EXPECT_EQ(expectation.is_contradicted_by(ray, 0), !grazes);
    grazing += grazes ? 1 : 0;
  }
  EXPECT_GT(grazing, 5);
}

// The surface's error is along its normal: on an inclined face it is more along the ray.
TEST_F(AgreementTest, OnAnInclinedFaceTheSurfacesErrorIsMoreAlongTheRay) {
  VERIFIES("LASSO-REG-029~2");
  parameters().sigma0_m = 1e-6;
  parameters().surface_sigma_m = 1e-3;
  scan();
  const Expectation expectation(mission_, truth(), {});
  int allowed = 0;
  for (ScanRay<N> ray : workspace_->rays) {
    if (ray.state != RayState::kHit) continue;
    ray.range = bounded<N::Length>(ray.range - N::to_length(0.0055));  // in front of all faces
    allowed += expectation.is_contradicted_by(ray, 1e-12) ? 0 : 1;
  }
  EXPECT_GT(allowed, 0.9 * returns()) << "no face is seen at less than 25 deg";
}

TEST_F(AgreementTest, WhatLiesBeyondTheSensorsRangesNeedNotReturn) {
  VERIFIES("LASSO-REG-029~2");
  scan();
  for (ScanRay<N>& ray : workspace_->rays) ray.state = RayState::kMiss;
  for (const bool far : {false, true}) {
    MissionParameters p = test::box_mission().parameters;
    (far ? p.range_max_m : p.range_min_m) = far ? 2 : 3;
    mission_.parameters = p;
    const Expectation expectation(mission_, truth(), {});
    for (const ScanRay<N>& ray : workspace_->rays) EXPECT_FALSE(expectation.is_contradicted_by(ray, 0));
  }
}

// The target of uneven boxes, of which one is gone, or has moved.
class ChangedTargetTest : public test::PoseFixture {
 protected:
  ChangedTargetTest() : PoseFixture(uneven_mission()) {}
  static const Mission& uneven_mission() {
    static const test::LoadedImage loaded(test::uneven_boxes());
    return loaded.mission;
  }
  PoseReason reason_of(const test::Boxes& scene) {
    scan_.model = scene[0];
    scan_.others.assign(scene.begin() + 1, scene.end());
    scan_.sigma_m = 1e-3;
    scan_.side = 40;
    const auto image = test::scan_box(scan_, random_);
    const auto estimator = std::make_unique<Estimator>();
    return estimator->estimate(mission_, *image, StartPoint{scan_.T_sensor_target, Twist{}}).reason;
  }
};

TEST_F(ChangedTargetTest, IsToldByItsRays) {
  VERIFIES("LASSO-REG-029~2");
  const test::Boxes whole = test::uneven_boxes();
  ASSERT_GT(whole.size(), 1u);
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.3, 0.1, random_);
    EXPECT_EQ(reason_of(whole), PoseReason::kValid) << i;
    test::Boxes gone = whole;
    gone.pop_back();
    EXPECT_EQ(reason_of(gone), PoseReason::kModelMismatch) << i;
    test::Boxes moved = whole;
    moved.back().center += Vec3(0.05, -0.05, 0.05);
    EXPECT_NE(reason_of(moved), PoseReason::kValid) << i;
  }
}

}  // namespace
}  // namespace lasso
