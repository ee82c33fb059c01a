#include "fsw/pose/registration/registration.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr int kOpening = 1;        // passes before those over all points
constexpr int kSecondOpening = 1;  // the same of the second look
constexpr int kCutOpening = 2;     // of either, where the first step was cut
constexpr int kFirstPatience = 3;  // passes after which a step within the pose's own uncertainty ends a look
constexpr int kSecondPatience = 5;

class RegisterTest : public test::PoseFixture {
 protected:
  RegisterTest() { scan_.side = 24; }

  HitSolution register_from(double rotation_rad, double shift_m) {
    return register_hits(mission_, inverse(test::disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_)), *workspace_);
  }
  void never_small_enough() { parameters().stop_translation_m = 0; }
};

TEST_F(RegisterTest, ConvergesInFewPasses) {
  VERIFIES("LASSO-REG-001~1 LASSO-REG-011~2");
  for (int i = 0; i < 15; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.2, 0.1, random_);
    scan();
    const HitSolution solution = register_from(0.01, 0.005);
    EXPECT_EQ(solution.stop, StopReason::kConverged);
    EXPECT_LE(solution.iterations, kOpening + 4);
    EXPECT_GT(solution.inliers, 0.99 * static_cast<double>(workspace_->points.size()));
    EXPECT_LE(solution.usable, workspace_->points.size());
    EXPECT_LT(error_of(solution.T_target_sensor).head<3>().norm(), 5e-5);
    EXPECT_LT(error_of(solution.T_target_sensor).tail<3>().norm(), 2e-5);
  }
}

TEST(ExplainedShare, IsThatOfTheUsablePointsAndNoneOfNone) {
  VERIFIES("LASSO-REG-007~2");
  HitSolution solution;
  EXPECT_EQ(explained_share(solution), 0);
  solution.usable = 8;
  solution.inliers = 6;
  EXPECT_EQ(explained_share(solution), 0.75);
}

TEST_F(RegisterTest, OnePassOverAllPointsIsEnoughAtTheTruth) {
  VERIFIES("LASSO-REG-001~1");
  scan();
  const HitSolution solution = register_from(0, 0);
  EXPECT_EQ(solution.stop, StopReason::kConverged);
  EXPECT_EQ(solution.iterations, kOpening + 1);
}

TEST_F(RegisterTest, APoseWithoutReturnsCostsMoreThanAny) {
  VERIFIES("LASSO-MOD-115~2");
  scan();
  EXPECT_LT(cost_of_hits(mission_, truth(), *workspace_), 2);
  workspace_->points.clear();
  EXPECT_GT(cost_of_hits(mission_, truth(), *workspace_), 1e200);
}

TEST_F(RegisterTest, AReturnThatTheAssumedNoiseWouldExcuseStandsOutWhereTheScanHasLess) {
  VERIFIES("LASSO-REG-001~1 LASSO-REG-020~2");
  scan();
  MatchPoint<N>& wrong = workspace_->points[workspace_->points.size() / 3];
  for (int i = 0; i < 3; ++i) {  // by 5 assumed sigmas of a kernel of 10
    const N::Length along = N::to_length(5e-3) * wrong.u[i];
    wrong.p[i] += along;
  }
  const HitSolution solution = register_from(0.003, 0.002);
  EXPECT_EQ(solution.stop, StopReason::kConverged);
  EXPECT_EQ(solution.inliers, workspace_->points.size() - 1);
  EXPECT_LT(error_of(solution.T_target_sensor).norm(), 1e-5);
}

TEST_F(RegisterTest, SumsOfResidualsTellTheNoise) {
  VERIFIES("LASSO-REG-003~2");
  scan_.sigma_m = 2e-3;
  double chi_squared = 0;
  double squared = 0;
  double freedom = 0;
  for (int i = 0; i < 6; ++i) {
    scan();
    const HitSolution solution = register_from(0.003, 0.002);
    chi_squared += solution.chi_squared;
    squared += solution.squared_residual_m2;
    freedom += solution.inliers - 6;
  }
  // Twice the assumed sigma, seen through Tukey's kernel of 10 assumed sigmas.
  EXPECT_NEAR(chi_squared / freedom, 4 * (1 - 6 / 25.0 + 15 / 625.0), 0.3);
  EXPECT_NEAR(squared / freedom, 4e-6, 0.4e-6);
}

TEST_F(RegisterTest, TheInformationIsTheInverseOfTheErrorsCovariance) {
  VERIFIES("LASSO-REG-003~2");
  scan_.sigma_m = 1e-3;
  double nees = 0;
  constexpr int kScans = 40;
  for (int i = 0; i < kScans; ++i) {
    scan();
    const HitSolution solution = register_from(0.003, 0.002);
    // The error as the step from the estimate to the truth, target axes.
    const Pose step = truth() * inverse(solution.T_target_sensor);
    Vec6 x;
    x << log_so3(step.q), truth().p - rotate(step.q, solution.T_target_sensor.p);
    nees += x.dot(solution.H * x) / kScans;
  }
  EXPECT_NEAR(nees, 6, 1.2);
}

TEST_F(RegisterTest, AStepMayGoAsFarAsTheNoiseReaches) {
  VERIFIES("LASSO-REG-001~1");
  parameters().gate_first_m = 1e-6;
  scan();
  const HitSolution solution = register_from(0.0004, 0.0003);
  EXPECT_EQ(solution.stop, StopReason::kConverged);
  EXPECT_LT(error_of(solution.T_target_sensor).norm(), 1e-4);
}

// A box of sheets without thickness, open towards the sensor: returns come from the insides of its walls.
TEST_F(RegisterTest, SheetsAreMatchedFromBehind) {
  VERIFIES("LASSO-REG-001~1");
  std::vector<Element<N>> sheets(mission_.field.elements, mission_.field.elements + mission_.field.element_count);
  for (Element<N>& e : sheets) e.flags = kElementTwoSided;
  mission_.field.elements = sheets.data();
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::disturb(test::generic_box_pose(), 0.2, 0.1, random_);
    scan();
    for (MatchPoint<N>& point : workspace_->points) {
      const Vec3 u_sensor = to_vec3(point.u);
      const Vec3 u = rotate(truth().q, u_sensor);
      const Vec3 m = truth().p - scan_.model.center;
      const Vec3 farther = scan_.model.half.cwiseProduct(u.cwiseSign()) - m;  // the farther of each axis' two faces
      const double range = farther.cwiseQuotient(u).minCoeff();
      for (int axis = 0; axis < 3; ++axis) point.p[axis] = N::to_length(range * u_sensor[axis]);
    }
    const HitSolution solution = register_from(0.01, 0.005);
    EXPECT_EQ(solution.stop, StopReason::kConverged);
    EXPECT_GT(explained_share(solution), 0.97);
    EXPECT_LT(error_of(solution.T_target_sensor).head<3>().norm(), 2e-4);
    EXPECT_LT(error_of(solution.T_target_sensor).tail<3>().norm(), 1e-4);
  }
}

TEST_F(RegisterTest, PointsThatChangeSidesKeepNoScanFromItsEnd) {
  VERIFIES("LASSO-REG-018~1");
  for (int i = 0; i < 400; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan_.sigma_m = i % 2 == 0 ? 1e-3 : 5e-3;
    scan();
    EXPECT_EQ(register_from(0.003, 0.003).stop, StopReason::kConverged) << i;
  }
}

TEST_F(RegisterTest, StopsAtTheIterationLimit) {
  VERIFIES("LASSO-REG-007~2 LASSO-REG-011~2");
  scan_.sigma_m = 1e-3;
  scan();
  never_small_enough();
  parameters().iterations_max = 1;
  const HitSolution solution = register_from(0.005, 0.003);
  EXPECT_EQ(solution.stop, StopReason::kIterationLimit);
  EXPECT_EQ(solution.iterations, kOpening + 1);
}

TEST_F(RegisterTest, LooksASecondTimeWhereReturnsStayUnexplained) {
  VERIFIES("LASSO-REG-006~2");
  scan_.outliers = 0.2;
  scan_.sigma_m = 1e-3;
  scan();
  never_small_enough();
  parameters().iterations_max = 1;
  const HitSolution solution = register_from(0.005, 0.003);
  EXPECT_EQ(solution.iterations, kOpening + 1 + kSecondOpening + 1);
  EXPECT_LT(error_of(solution.T_target_sensor).tail<3>().norm(), 2e-3);
}

// Half of the scans have outliers and get a second look: looks that creep.
TEST_F(RegisterTest, LooksThatCreepEndWithinThePosesOwnUncertainty) {
  VERIFIES("LASSO-REG-020~2");
  scan_.sigma_m = 1e-3;
  int late = 0;
  double nees = 0;
  for (int i = 0; i < 400; ++i) {
    scan_.outliers = i % 2 == 0 ? 0.05 : 0;
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const HitSolution solution = register_from(0.008, 0.006);
    EXPECT_EQ(solution.stop, StopReason::kConverged) << i;
    if (solution.iterations <= (i % 2 == 0 ? kSecondPatience : kFirstPatience)) continue;
    ++late;
    const Pose step = truth() * inverse(solution.T_target_sensor);
    Vec6 x;
    x << log_so3(step.q), truth().p - rotate(step.q, solution.T_target_sensor.p);
    nees += x.dot(solution.H * x);
    EXPECT_LE(solution.iterations, kSecondPatience + 5) << i;  // with steps below a sigma only: 11
  }
  EXPECT_GT(late, 100);
  EXPECT_NEAR(nees / late, 6, 1);
}

// What a search compares has gone as far as the returns lead it. Where they are noisier than the sensor is known to be, and one in ten is
// wrong, two looks within the pose's own uncertainty take 14 passes or more of one scan in eighty.
TEST_F(RegisterTest, ASearchesLooksGoOnWithinThePosesOwnUncertainty) {
  VERIFIES("LASSO-REG-020~2");
  scan_.sigma_m = 1e-2;
  scan_.outliers = 0.1;
  int late = 0;
  for (int i = 0; i < 200; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.008, 0.006, random_));
    int passes = 0;
    for (const RegisterLook look : {RegisterLook::kFirst, RegisterLook::kSecond}) {
      passes += register_look(mission_, look, start, *workspace_).iterations;
    }
    late += passes >= 14 ? 1 : 0;
  }
  EXPECT_GT(late, 30);
}

// A ray aimed at a contour may have met what a pose that is a little off has beside it.
TEST_F(RegisterTest, AnAimedReturnThatMeetsNothingIsNotHeldAgainstThePose) {
  VERIFIES("LASSO-REG-017~2");
  scan();
  for (std::size_t i = 0; i < workspace_->points.size(); i += 20) {
    for (N::Length& p : workspace_->points[i].p) p = N::to_length(0.8 * static_cast<double>(p));  // half a metre in front of the box
  }
  const HitSolution doubted = register_from(0.005, 0.003);
  EXPECT_EQ(doubted.usable, workspace_->points.size());
  EXPECT_LT(explained_share(doubted), 0.96);
  for (std::size_t i = 0; i < workspace_->points.size(); i += 10) workspace_->points[i].aimed = true;
  const HitSolution solution = register_from(0.005, 0.003);
  EXPECT_EQ(solution.inliers, doubted.inliers);
  EXPECT_EQ(explained_share(solution), 1);
}

TEST_F(RegisterTest, AnAimedReturnAFewSigmasOffASurfaceIsHeldAgainstThePose) {
  VERIFIES("LASSO-REG-017~2");
  scan();
  MatchPoint<N>& wrong = workspace_->points[workspace_->points.size() / 3];
  wrong.aimed = true;
  for (int i = 0; i < 3; ++i) {  // by 5 assumed sigmas, of the 10 that its match reaches
    const N::Length along = N::to_length(5e-3) * wrong.u[i];
    wrong.p[i] += along;
  }
  const HitSolution solution = register_from(0.003, 0.002);
  EXPECT_EQ(solution.usable, workspace_->points.size());
  EXPECT_EQ(solution.inliers, workspace_->points.size() - 1);
  EXPECT_LT(explained_share(solution), 1);
}

TEST_F(RegisterTest, TheSecondLookReachesFarther) {
  VERIFIES("LASSO-REG-001~1");
  scan();
  for (const double gates : {-3.0, -2.0, 2.0, 3.0}) {  // beyond the first look's gate, within the second's
    Pose start = scan_.T_sensor_target;
    start.p[2] += gates * parameters().gate_first_m;
    const HitSolution solution = register_hits(mission_, inverse(start), *workspace_);
    EXPECT_GT(solution.iterations, kCutOpening + kCutOpening);
    EXPECT_EQ(solution.stop, StopReason::kConverged);
    EXPECT_LT(error_of(solution.T_target_sensor).tail<3>().norm(), 2e-5);
  }
}

TEST_F(RegisterTest, TheCostIsTheMeanSquaredResidualAndMoreOfWhatIsLeftOut) {
  VERIFIES("LASSO-MOD-115~2");
  EXPECT_GT(mean_cost(HitSolution()), 1e9);
  HitSolution half;
  half.usable = 4;
  half.inliers = 2;
  half.chi_squared = 3;
  EXPECT_DOUBLE_EQ(mean_cost(half), (3 + 2 * kUnexplainedCost) / 4);
}

TEST_F(RegisterTest, WeighingAPoseLeavesItWhereItIs) {
  VERIFIES("LASSO-MOD-115~2");
  scan_.sigma_m = 1e-3;
  scan();
  const HitSolution truly = weigh_hits(mission_, truth(), *workspace_);
  EXPECT_EQ(truly.T_target_sensor.p, truth().p);
  EXPECT_NEAR(mean_cost(truly), 1, 0.25);
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.02, 0.01, random_));
  EXPECT_GT(mean_cost(weigh_hits(mission_, start, *workspace_)), 3);
  workspace_->points.clear();
  EXPECT_EQ(weigh_hits(mission_, truth(), *workspace_).usable, 0u);
}

TEST_F(RegisterTest, TooFewPointsLeaveTheStart) {
  VERIFIES("LASSO-REG-007~2");
  scan();
  keep_first_points(11);
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.01, 0.01, random_));
  const HitSolution solution = register_hits(mission_, start, *workspace_);
  EXPECT_EQ(solution.stop, StopReason::kTooFewPoints);
  EXPECT_EQ(solution.iterations, 0);
  EXPECT_EQ(solution.inliers, 0u);
  EXPECT_EQ(solution.T_target_sensor.p, start.p);
  EXPECT_EQ(solution.T_target_sensor.q.coeffs(), start.q.coeffs());
}

TEST_F(RegisterTest, PointsThatMeetNothingAreTooFew) {
  VERIFIES("LASSO-REG-007~2");
  scan();
  Pose start = truth();
  start.p += Vec3(0.7, 0.8, -0.9);
  const HitSolution solution = register_hits(mission_, start, *workspace_);
  EXPECT_EQ(solution.stop, StopReason::kTooFewPoints);
  EXPECT_EQ(solution.inliers, 0u);
  EXPECT_EQ(solution.usable, workspace_->points.size());
  EXPECT_EQ(solution.T_target_sensor.p, start.p);
}

TEST_F(RegisterTest, SumsWithoutASolutionAreSaid) {
  VERIFIES("LASSO-REG-007~2 LASSO-REG-012~1");
  scan();
  mission_.radius_m = 1e12;  // so large that the turns drown the shifts in rounding
  const Pose start = truth();
  const HitSolution solution = register_hits(mission_, start, *workspace_);
  EXPECT_EQ(solution.stop, StopReason::kSingular);
  EXPECT_EQ(solution.T_target_sensor.p, start.p);
}

}  // namespace
}  // namespace lasso
