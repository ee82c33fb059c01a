// align_coarsely (registration.hpp).
#include <gtest/gtest.h>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

class AfarTest : public test::PoseFixture {
 protected:
  AfarTest() { scan_.sigma_m = 1e-3; }

  // What is off, in rotation and translation, after coarse alignment and a look from a start that is up to so much off.
  Vec6 error_from(double rotation_rad, double shift_m) {
    const Pose start = inverse(test::disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_));
    return error_of(register_first(mission_, align_coarsely(mission_, start, *workspace_), *workspace_).T_target_sensor);
  }
};

TEST_F(AfarTest, ConvergesFromTwentyDegreesAndAQuarterOfTheSize) {
  VERIFIES("LASSO-REG-005~1");
  constexpr int kStarts = 200;
  const double rotation_rad = 20 * kPi / 180;
  const double shift_m = 0.25 * static_cast<double>(mission_.search.size_m);
  int lost = 0;
  for (int i = 0; i < kStarts; ++i) {
    if (i % 10 == 0) {
      scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.15, 0.1, random_);
      scan();
    }
    const Vec6 error = error_from(rotation_rad, shift_m);
    if (error.tail<3>().norm() > 2e-3 || error.head<3>().norm() > 5e-3) ++lost;
  }
  EXPECT_LE(lost, kStarts / 100);
}

// The middle of what is seen is then not the middle of the visible side: the first minimum is often a slide along a face.
TEST_F(AfarTest, PartOfTheTargetIsEnough) {
  VERIFIES("LASSO-REG-005~1");
  int lost = 0;
  constexpr int kStarts = 60;
  for (int i = 0; i < kStarts; ++i) {
    scan();
    keep_points([](std::size_t, const MatchPoint<N>& point) { return point.p[0] > N::Length{0} || point.p[1] > N::to_length(0.1); });
    if (error_from(0.25, 0.2 * mission_.radius_m).tail<3>().norm() > 3e-3) ++lost;
  }
  EXPECT_LE(lost, kStarts / 20);
}

// Slides are pulled by all of so few: half of them would be too few to solve for a pose.
TEST_F(AfarTest, TwentyPointsAreEnough) {
  VERIFIES("LASSO-REG-005~1");
  int lost = 0;
  constexpr int kStarts = 60;
  for (int i = 0; i < kStarts; ++i) {
    scan();
    const std::size_t stride = workspace_->points.size() / 20;
    keep_points([stride](std::size_t index, const MatchPoint<N>&) { return index % stride == 0; });
    ASSERT_LT(workspace_->points.size(), 2 * kMinimumPoints);
    if (error_from(0.25, 0.2 * mission_.radius_m).tail<3>().norm() > 5e-3) ++lost;
  }
  EXPECT_LE(lost, kStarts / 20);
}

TEST_F(AfarTest, IsNeededFromThere) {
  VERIFIES("LASSO-REG-005~1");
  scan();
  int lost = 0;
  for (int i = 0; i < 10; ++i) {
    const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.35, 0.25 * mission_.radius_m, random_));
    if (error_of(register_hits(mission_, start, *workspace_).T_target_sensor).tail<3>().norm() > 2e-3) ++lost;
  }
  EXPECT_GT(lost, 7);
}

TEST_F(AfarTest, TooFewPointsLeaveTheStart) {
  VERIFIES("LASSO-REG-005~1");
  scan();
  for (const std::size_t count : {std::size_t{11}, std::size_t{0}}) {
    keep_first_points(count);
    const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.3, 0.1, random_));
    const Pose result = align_coarsely(mission_, start, *workspace_);
    EXPECT_EQ(result.p, start.p);
    EXPECT_EQ(result.q.coeffs(), start.q.coeffs());
  }
}

TEST_F(AfarTest, PointsBeyondTheFieldsReachAreLeftOut) {
  VERIFIES("LASSO-REG-007~2");
  scan();
  for (std::size_t k = 0; k < workspace_->points.size() / 2; ++k) workspace_->points[k].p[2] = N::to_length(1e7);
  const Pose moved = align_coarsely(mission_, truth(), *workspace_);
  EXPECT_TRUE(is_valid(moved));
  EXPECT_EQ(register_hits(mission_, moved, *workspace_).stop, StopReason::kTooFewPoints);
}

TEST_F(AfarTest, AScanOfSomethingElseStaysFinite) {
  VERIFIES("LASSO-REG-012~1");
  scan();
  for (MatchPoint<N>& point : workspace_->points) {
    for (N::Length& p : point.p) p = N::to_length(random_.uniform(0.2, 300) * static_cast<double>(p));
  }
  EXPECT_TRUE(is_valid(align_coarsely(mission_, truth(), *workspace_)));
}

}  // namespace
}  // namespace lasso
