#include "fsw/pose/recognition/robust_refinement.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/portable_math.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class SwayTest : public test::SearchFixture {
 protected:
  // Registrations that were made of it.
  int run(const Pose& start, const RobustSettings& care = kUsualRobust) {
    const auto subset = make_evidence();
    robust_refiner_.begin(start, Mat6::Identity(), care);
    int steps = 1;
    while (robust_refiner_.step(mission_, *subset, *workspace_, work_)) ++steps;
    return steps;
  }
  double error_deg() const { return error_of(robust_refiner_.T_target_sensor()).head<3>().norm() / kRadPerDeg; }
  Pose turned(double degrees) const {
    Pose pose = scan_.T_sensor_target;
    pose.q = normalized(pose.q * exp_so3(degrees * kRadPerDeg * Vec3(0.36, -0.48, 0.8)));
    return inverse(pose);
  }

  RobustRefiner robust_refiner_;
  std::uint32_t work_ = 0;
};

TEST_F(SwayTest, WhatIsExplainedStaysAsItIs) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  EXPECT_EQ(run(truth()), 1);
  EXPECT_EQ(robust_refiner_.T_target_sensor().p, truth().p);
  EXPECT_EQ(robust_refiner_.H(), Mat6::Identity());
  EXPECT_LT(robust_refiner_.region_costs().cost, kCleanCost);
  EXPECT_GT(work_, 0u);
}

TEST_F(SwayTest, APoseThatIsOffIsMovedToWhatExplainsTheReturns) {
  VERIFIES("LASSO-MOD-111~1");
  int right = 0;
  for (int i = 0; i < 100; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    EXPECT_LE(run(turned(4)), 15);  // a look, no turn and each turn, each once more
    right += error_deg() < 0.5 && robust_refiner_.region_costs().cost < kCleanCost ? 1 : 0;
  }
  EXPECT_GE(right, 85);
}

// The smaller boxes stand turned against the model of the whole, and are most of what is seen.
TEST_F(SwayTest, APartThatIsTurnedDoesNotKeepThePose) {
  VERIFIES("LASSO-MOD-111~1");
  for (test::BoxModel& box : scan_.others) box.center += Vec3(0, 0, 0.012);
  int right = 0;
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    (void)run(turned(3), i % 2 == 0 ? kUsualRobust : kThoroughRobust);
    right += error_deg() < 2 ? 1 : 0;
  }
  EXPECT_GE(right, 7);
}

TEST_F(SwayTest, WithoutReturnsNothingIsExplained) {
  VERIFIES("LASSO-MOD-111~1");
  const auto none = std::make_unique<ScanSubset>();
  EXPECT_EQ(weigh_regions(mission_, truth(), *none, *workspace_).cost, kLostCost);
}

// At the true pose the returns of a box that is not there cost all the same, however far it has gone; those of the others do not.
TEST_F(SwayTest, APartThatIsElsewhereCostsItsRegionsAndNoMore) {
  VERIFIES("LASSO-MOD-111~1");
  const auto cost_with_the_arm_off_by = [this](double off_m) {
    scan_.others = {test::uneven_boxes()[1], test::uneven_boxes()[2]};
    scan_.others[1].center += Vec3(0, 0, off_m);
    scan();
    const auto subset = make_evidence();
    const RegionCosts region_costs = weigh_regions(mission_, truth(), *subset, *workspace_);
    double lost = 0;
    for (std::size_t i = 0; i < subset->hits.size(); ++i) lost += region_costs.explained[subset->regions[i]] ? 0 : 1;
    EXPECT_NEAR(region_costs.cost,
                (1 - lost / static_cast<double>(subset->hits.size())) + kLostCost * lost / static_cast<double>(subset->hits.size()), 0.5);
    return region_costs.cost;
  };
  const double none = cost_with_the_arm_off_by(0);
  EXPECT_NEAR(none, 1, 0.2);
  const double little = cost_with_the_arm_off_by(0.06);
  EXPECT_GT(little, 1.15 * none);
  EXPECT_NEAR(cost_with_the_arm_off_by(0.10), little, 0.3 * little);
}

}  // namespace
}  // namespace lasso
