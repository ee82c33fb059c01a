#include "fsw/pose/near_symmetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "fsw/pose/estimator.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

template <class Fixture>
class AskingTest : public Fixture {
 protected:
  // By an estimator that found the pose to explain such a share of a new scan.
  bool is_told(const Pose& T_target_sensor, double inlier_share) {
    const auto image = test::scan_box(this->scan_, this->random_);
    Registration registration = estimator_->estimate(this->mission_, *image, {this->scan_.T_sensor_target, Twist{}});
    registration.T_sensor_target = inverse(T_target_sensor);
    registration.inlier_share = inlier_share;
    return estimator_->has_better_twin(this->mission_, *image, registration);
  }

  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
};

// A single box: each half turn about its axes is a symmetry.
class NearSymmetryTest : public AskingTest<test::PoseFixture> {
 protected:
  NearSymmetryTest() { scan_.sigma_m = 1e-3; }
  bool has_better(double margin, const Pose& T_target_sensor) {
    scan();
    return has_twin_better_by(mission_, margin, T_target_sensor, true, *workspace_);
  }
};

class NearlySymmetricTest : public AskingTest<test::SearchFixture> {
 protected:
  bool has_better(const Pose& T_target_sensor) {
    scan();
    return has_twin_better_by(mission_, 0.1, T_target_sensor, true, *workspace_);
  }
  Pose turned(int i) const { return twin_of(mission_.search.symmetries[static_cast<std::size_t>(i) % 3], truth()); }
};

constexpr double kAnyMargin = -1e8;

TEST_F(NearSymmetryTest, ATwinIsThePoseTurnedAboutTheBoxesMiddle) {
  VERIFIES("LASSO-MOD-183~2");
  ASSERT_GE(mission_.search.symmetries.size(), 3u);
  for (const auto& symmetry : mission_.search.symmetries) {
    const Pose twin = twin_of(symmetry, truth());
    for (int i = 0; i < 10; ++i) {
      const Vec3 here = test::random_vec3(random_, 0.3);  // from the middle
      const Vec3 seen = scan_.T_sensor_target * Vec3(scan_.model.center + here);
      EXPECT_LT((Vec3(twin * seen - scan_.model.center).cwiseAbs() - here.cwiseAbs()).norm(), 1e-6);
    }
    EXPECT_LT(std::abs((twin.q * scan_.T_sensor_target.q).w()), 1e-6) << "half a turn";
  }
}

TEST_F(NearSymmetryTest, TheTwinsOfASymmetricTargetExplainItsScanAsWell) {
  VERIFIES("LASSO-MOD-183~2");
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    EXPECT_TRUE(has_better(-0.1, truth())) << i;
    EXPECT_FALSE(has_better(0.1, truth())) << i;
  }
}

TEST_F(NearSymmetryTest, APoseThatIsALittleOffIsComparedAsItWouldBeRegistered) {
  VERIFIES("LASSO-MOD-183~2");
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(has_better(0.1, inverse(test::disturb(scan_.T_sensor_target, 0.02, 0.01, random_)))) << i;
}

TEST_F(NearSymmetryTest, ThereIsNoTwinWithoutSymmetryOrReturns) {
  VERIFIES("LASSO-MOD-183~2");
  parameters().inliers_min = 1e6;
  EXPECT_FALSE(has_better(kAnyMargin, truth()));
  parameters().inliers_min = 60;
  EXPECT_TRUE(has_better(kAnyMargin, truth()));
  keep_first_points(0);
  EXPECT_FALSE(has_twin_better_by(mission_, kAnyMargin, truth(), true, *workspace_));
  mission_.search.symmetries = {};
  EXPECT_FALSE(has_better(kAnyMargin, truth()));
}

TEST_F(NearSymmetryTest, MissesCountWhereTheyAreKnownAndThereAreAny) {
  VERIFIES("LASSO-MOD-183~2 LASSO-REG-009~1");
  const auto is_better = [this](double margin, const Pose& pose, bool misses_known) {
    return has_twin_better_by(mission_, margin, pose, misses_known, *workspace_);
  };
  scan();
  EXPECT_TRUE(is_better(-0.1, truth(), false));
  EXPECT_FALSE(is_better(0.1, truth(), false));
  for (ScanRay<FlightNumber>& ray : workspace_->rays) ray.state = RayState::kHit;
  EXPECT_TRUE(is_better(-0.1, truth(), true));
  EXPECT_FALSE(is_better(0.1, truth(), true));
  Pose away = truth();
  away.p += Vec3(0, 0, 3);
  for (MatchPoint<FlightNumber>& point : workspace_->points) point.aimed = true;  // none of them has to meet anything
  EXPECT_FALSE(is_better(0.1, away, false)) << "where nothing is met no twin is better";
}

// Half a turn about the larger box explains most of the scan, and the right pose all of it.
TEST_F(NearlySymmetricTest, TheRightPoseHasTheAdvantageOverItsTwins) {
  VERIFIES("LASSO-MOD-183~2");
  int told = 0;
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    EXPECT_FALSE(has_better(truth())) << i;
    told += has_better(turned(i)) ? 1 : 0;
  }
  EXPECT_GE(told, 18);
}

// Asked where returns stay unexplained, and of them alone.
TEST_F(NearlySymmetricTest, APoseThatExplainsAllIsNotAsked) {
  VERIFIES("LASSO-MOD-183~2");
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    EXPECT_FALSE(is_told(truth(), 0.98)) << i;
    EXPECT_TRUE(is_told(turned(i), 0.98)) << i;
    EXPECT_FALSE(is_told(turned(i), 0.995)) << i;
  }
}

TEST_F(NearlySymmetricTest, APartOfTheReturnsIsAsked) {
  VERIFIES("LASSO-MOD-183~2");
  scan_.side = 48;
  scan();
  ASSERT_GT(workspace_->points.size(), kTwinPoints);
  (void)has_twin_better_by(mission_, 0, truth(), true, *workspace_);
  EXPECT_LE(workspace_->points.size(), kTwinPoints);
  EXPECT_GT(workspace_->points.size(), kTwinPoints / 2);
  const std::size_t few = workspace_->points.size();
  (void)has_twin_better_by(mission_, 0, truth(), true, *workspace_);
  EXPECT_EQ(workspace_->points.size(), few);
}

class TwinAgreementTest : public test::PoseFixture {
 protected:
  // By brute force: does the box stand in the ray's way, seen from the pose?
  bool meets(const ScanRay<FlightNumber>& ray, const Pose& T_target_sensor) const {
    Vec3 o;
    Vec3 u;
    for (int i = 0; i < 3; ++i) {
      o[i] = static_cast<double>(ray.o[i]);
      u[i] = static_cast<double>(ray.u[i]);
    }
    return test::cast_box(scan_.model, T_target_sensor * o, rotate(T_target_sensor.q, u)) > 0;
  }
  // Misses that `pose` says should have hit, among every stride-th; and all misses.
  double violated_share(const Pose& pose, std::size_t stride, std::size_t& misses) const {
    double violated = 0;
    double looked_up = 0;
    misses = 0;
    for (const ScanRay<FlightNumber>& ray : workspace_->rays) {
      if (ray.state != RayState::kMiss || misses++ % stride != 0) continue;
      looked_up += 1;
      violated += meets(ray, pose) ? 1 : 0;
    }
    return violated / looked_up;
  }
  double agreement(const Pose& pose, std::uint32_t inliers, std::uint32_t returns, bool misses_known = true) const {
    return hit_miss_agreement(mission_, pose, inliers, returns, misses_known, *workspace_);
  }
};

TEST_F(TwinAgreementTest, IsTheShareOfRaysThatAreAsPredicted) {
  VERIFIES("LASSO-MOD-183~2");
  scan_.side = 9;
  scan_.rates.v_mps = Vec3(0.3, -0.2, 0.5);  // rays with an origin of their own
  int blamed = 0;
  for (int i = 0; i < 30; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.3, 0.15, random_));
    std::size_t misses = 0;
    const double violated = violated_share(pose, 1, misses);
    if (misses > 63) continue;  // more are sampled
    const auto m = static_cast<double>(misses);
    EXPECT_NEAR(agreement(pose, 30, 40), (30 + m * (1 - violated)) / (40 + m), 1e-12);
    blamed += violated > 0.1 ? 1 : 0;
    mission_.parameters.dropout_probability = 0.1;
    EXPECT_NEAR(agreement(pose, 30, 40), (30 + m * (1 - std::max(0.0, violated - 0.1))) / (40 + m), 1e-12);
    mission_.parameters.dropout_probability = 0;
  }
  EXPECT_GT(blamed, 10);
}

TEST_F(TwinAgreementTest, ManyMissesAreSampledEvenly) {
  VERIFIES("LASSO-MOD-183~2");
  scan();
  const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.3, 0.15, random_));
  std::size_t misses = 0;
  const double all = violated_share(pose, 1, misses);
  ASSERT_GT(misses, 300u);
  const double sampled = violated_share(pose, misses / 64 + 1, misses);
  EXPECT_GT(sampled, 0.02);
  EXPECT_NEAR(sampled, all, 0.05);
  const auto m = static_cast<double>(misses);
  EXPECT_NEAR(agreement(pose, 300, 400), (300 + m * (1 - sampled)) / (400 + m), 1e-12);
}

TEST_F(TwinAgreementTest, IsOneAtTheTruth) {
  VERIFIES("LASSO-MOD-183~2");
  scan();
  EXPECT_EQ(agreement(truth(), 400, 400), 1);
}

TEST_F(TwinAgreementTest, UnknownMissesDoNotCount) {
  VERIFIES("LASSO-REG-009~1");
  scan();
  EXPECT_EQ(agreement(truth(), 30, 40, false), 0.75);
  EXPECT_EQ(agreement(truth(), 0, 0, false), 0);
  workspace_->rays.clear();
  EXPECT_EQ(agreement(truth(), 30, 40, true), 0.75);
}

TEST_F(TwinAgreementTest, WhatLiesBehindTheSensorIsNotMet) {
  VERIFIES("LASSO-MOD-183~2");
  scan();
  for (ScanRay<FlightNumber>& ray : workspace_->rays) ray.state = RayState::kMiss;
  EXPECT_LT(agreement(truth(), 0, 0), 0.9);
  Pose behind = scan_.T_sensor_target;
  behind.p = -behind.p;
  EXPECT_EQ(agreement(inverse(behind), 0, 0), 1);
}

TEST_F(TwinAgreementTest, WhatIsTooFarForTheFieldIsNotMet) {
  VERIFIES("LASSO-MOD-183~2");
  scan();
  Pose far = scan_.T_sensor_target;
  far.p[2] = 3e6 * scan_.model.cell_m;
  EXPECT_EQ(agreement(inverse(far), 0, 0), 1);
}

}  // namespace
}  // namespace lasso
