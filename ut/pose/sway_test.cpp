#include "fsw/pose/sway.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/portable_math.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class SwayTest : public test::SearchFixture {
 protected:
  // Registrations that were made of it.
  int run(const Pose& start) {
    const auto evidence = make_evidence();
    sway_.begin(start, Mat6::Identity());
    int steps = 1;
    while (sway_.step(mission_, *evidence, *workspace_, work_)) ++steps;
    return steps;
  }
  double error_deg() const { return error_of(sway_.T_target_sensor()).head<3>().norm() / kRadPerDeg; }
  Pose turned(double degrees) const {
    Pose pose = scan_.T_sensor_target;
    pose.q = normalized(pose.q * exp_so3(degrees * kRadPerDeg * Vec3(0.36, -0.48, 0.8)));
    return inverse(pose);
  }

  Sway sway_;
  std::uint32_t work_ = 0;
};

TEST_F(SwayTest, WhatIsExplainedStaysAsItIs) {
  VERIFIES("LASSO-MOD-115~1");
  scan();
  EXPECT_EQ(run(truth()), 1);
  EXPECT_EQ(sway_.T_target_sensor().p, truth().p);
  EXPECT_EQ(sway_.H(), Mat6::Identity());
  EXPECT_LT(sway_.cost(), kCleanCost);
  EXPECT_GT(work_, 0u);
}

TEST_F(SwayTest, APoseThatIsOffIsMovedToWhatExplainsTheReturns) {
  VERIFIES("LASSO-MOD-115~1");
  int right = 0;
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const int steps = run(turned(4));
    EXPECT_TRUE(steps == 7 || steps == 13) << steps;  // one round or two
    right += error_deg() < 0.5 && sway_.cost() < kCleanCost ? 1 : 0;
  }
  EXPECT_GE(right, 7);
}

// The smaller boxes stand turned against the model of the whole, and are most of what is seen.
TEST_F(SwayTest, APartThatIsTurnedDoesNotKeepThePose) {
  VERIFIES("LASSO-MOD-115~1");
  for (test::BoxModel& box : scan_.others) box.center += Vec3(0, 0, 0.012);
  int right = 0;
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    (void)run(turned(3));
    right += error_deg() < 2 ? 1 : 0;
  }
  EXPECT_GE(right, 7);
}

}  // namespace
}  // namespace lasso
