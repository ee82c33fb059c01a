// The passes, and the matching of single points in match.hpp and scan_sums.hpp that they are made of.
#include "fsw/pose/registration/gauss_newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ut/pose/brute_pass.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Point = MatchPoint<N>;
using test::BruteSums;
using test::meet;
using test::Met;

class GaussNewtonTest : public test::BrutePassFixture {};

// Of the range to the surface, at the slope that the ray has there; also for ranges that are far off, as noise can make them.
TEST_F(GaussNewtonTest, RowsAreTheDerivativesOfTheRange) {
  VERIFIES("LASSO-REG-001~1 LASSO-REG-021~1");
  scan();
  const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.01, 0.004, random_));
  int tested = 0;
  for (std::size_t i = 0; i < workspace_->points.size(); i += 7) {
    Point& point = workspace_->points[i];
    for (int k = 0; k < 3; ++k) point.p[k] = N::to_length(static_cast<double>(point.p[k]) - 0.03 * static_cast<double>(point.u[k]));
    const Met met = meet(scan_.model, pose, point);
    PassSums<N> sums(mission_.radius_m);
    match_points(mission_.field, to_path<N>(pose), settings(0.02), points().subspan(i, 1), {1, Lookup::kWalk}, sums);
    if (sums.rows.count() == 0 || !met.clear || std::abs(met.residual()) < 1e-3) continue;
    Mat6 H;
    Vec6 b;
    sums.rows.unpack(H, b);
    const Vec6 J = b * (met.residual() / sums.rows.chi_squared());  // b = w r J, chi^2 = w r^2
    for (int k = 0; k < 6; ++k) {
      const Vec6 step = 1e-5 * Vec6::Unit(k);
      const double slope = (meet(scan_.model, step_pose(pose, step), point).t - meet(scan_.model, step_pose(pose, -step), point).t) / 2e-5;
      EXPECT_NEAR(J[k], -slope * met.n.dot(met.u), 1e-3) << k;  // moving the scan by x takes J.x off the residual
    }
    ++tested;
  }
  EXPECT_GT(tested, 10);
}

TEST_F(GaussNewtonTest, SumsAreThoseOfABruteForcePass) {
  VERIFIES("LASSO-REG-001~1");
  for (int i = 0; i < 12; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    parameters().incidence_max_rad = i % 2 == 0 ? 0.9 : 1.5;
    const double gate_m = i % 3 == 0 ? 0 : 0.01;
    scan();
    const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.005, 0.005, random_));
    keep_clear_points(pose);
    const PassKind kind{i % 4 == 0 ? std::size_t{4} : 1};
    const MatchSettings<N> s = settings(gate_m);
    PassSums<N> sums(mission_.radius_m);
    match_points(mission_.field, to_path<N>(pose), s, points(), kind, sums);
    ASSERT_GT(sums.rows.count(), 12u);
    expect_sums(sums, brute(pose, gate_m, kind.stride), N::to_double(s.reference_variance));
  }
}

TEST_F(GaussNewtonTest, TheStepSolvesTheNormalEquations) {
  VERIFIES("LASSO-REG-001~1");
  scan();
  Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.004, 0.003, random_));
  const Pose before = pose;
  keep_clear_points(pose);
  const BruteSums truth = brute(pose, 0.01, 1);
  const Pass pass = take_pass(mission_, settings(0.01), {1, Lookup::kWalk}, *workspace_, pose);
  ASSERT_EQ(pass.status, Status::kOk);
  const Vec6 left = truth.H * pass.x - truth.b;  // three faces: the wide prior does not matter
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(left[i]), 2e-3 * std::sqrt(truth.H(i, i) * truth.chi_squared));
  const Pose stepped = step_pose(before, pass.x);
  EXPECT_EQ(pose.p, stepped.p);
  EXPECT_EQ(pose.q.coeffs(), stepped.q.coeffs());
  EXPECT_LT(error_of(pose).norm(), 0.2 * error_of(before).norm());
}

TEST_F(GaussNewtonTest, AStepThatTurnsBackIsHalvedAndThoseThatFollow) {
  VERIFIES("LASSO-REG-018~1");
  scan();
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.004, 0.003, random_));
  const auto step_after = [&](const Vec6& last, Descent& descent) {
    descent.last = last;
    Pose pose = start;
    const Pass pass = take_pass(mission_, settings(0.01), {1, Lookup::kWalk}, descent, *workspace_, pose);
    EXPECT_EQ(descent.last, pass.x);
    EXPECT_EQ(pose.p, step_pose(start, pass.x).p);
    return pass;
  };
  Descent descent;
  const Pass whole = step_after(Vec6::Zero(), descent);
  const Vec6 across = test::random_vec6(random_, 0.01);
  // At a right angle by the information's measure.
  const Vec6 beside = across - whole.x * (across.dot(whole.H * whole.x) / whole.x.dot(whole.H * whole.x));
  EXPECT_EQ(step_after(beside + 1e-6 * whole.x, descent).x, whole.x);
  EXPECT_EQ(step_after(beside - 1e-6 * whole.x, descent).x, Vec6(0.5 * whole.x));
  EXPECT_EQ(step_after(whole.x, descent).x, Vec6(0.5 * whole.x));
  EXPECT_EQ(step_after(-1e-3 * whole.x, descent).x, Vec6(0.25 * whole.x));
}

TEST_F(GaussNewtonTest, TheElementHitLastTimeIsOnlyAShortCut) {
  VERIFIES("LASSO-REG-010~1");
  scan();
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.004, 0.003, random_));
  Pose walked = start;
  const Pass walk = take_pass(mission_, settings(0.01), {1, Lookup::kWalk}, *workspace_, walked);
  Pose remembered = start;
  const Pass last = take_pass(mission_, settings(0.01), {1, Lookup::kLast}, *workspace_, remembered);
  for (Point& point : workspace_->points) point.element = (point.element + 2) % 6;  // a face that the ray does not hit
  Pose misled = start;
  const Pass wrong = take_pass(mission_, settings(0.01), {1, Lookup::kLast}, *workspace_, misled);
  EXPECT_EQ(walk.sums.rows.count(), last.sums.rows.count());
  EXPECT_LT((walk.x - last.x).norm(), 1e-6 * walk.x.norm());
  EXPECT_LT((walk.x - wrong.x).norm(), 1e-6 * walk.x.norm());
}

TEST_F(GaussNewtonTest, TooFewPointsTakeNoStep) {
  VERIFIES("LASSO-REG-007~2");
  scan();
  const Pose start = truth();
  for (std::size_t count : {std::size_t{kMinimumPoints}, std::size_t{kMinimumPoints - 1}}) {
    keep_first_points(count);
    Pose pose = start;
    const Pass pass = take_pass(mission_, settings(0.01), {1, Lookup::kWalk}, *workspace_, pose);
    EXPECT_EQ(pass.sums.rows.count(), count);
    EXPECT_EQ(pass.status, count == kMinimumPoints ? Status::kOk : Status::kNoData);
    EXPECT_EQ(pose.p == start.p, count < kMinimumPoints);
  }
}

// Sums of `count` rows that all look at n from m.
Pass equal_rows(const Vec3& m, const Vec3& n, double residual, int count) {
  Pass pass(test::box_mission());
  const auto path_m = test::path_vector<N::Length>(m);
  const auto path_n = test::path_vector<N::Unit>(n);
  const auto r = N::to_length(residual);
  for (int i = 0; i < count; ++i) pass.sums.rows.add(path_m.data(), path_n.data(), r, N::Weight{1}, r);
  pass.sums.rows.flush();
  return pass;
}

TEST_F(GaussNewtonTest, DirectionsThatNoRaySeesStayWhereTheyAre) {
  VERIFIES("LASSO-REG-008~2");
  scan();
  const Vec3 n(0, 0, 1);
  Pass pass = equal_rows(Vec3(0.1, 0.2, -0.1), n, 2e-3, 100);
  Pose pose = truth();
  Descent descent;
  solve_pass(mission_, settings(), descent, pass, pose);
  ASSERT_EQ(pass.status, Status::kOk);
  Vec6 J;
  J << Vec3(0.1, 0.2, -0.1).cross(n), n;
  EXPECT_NEAR(J.dot(pass.x), 2e-3, 1e-6);                       // the one direction that is seen
  EXPECT_LT((pass.x.tail<3>() - pass.x[5] * n).norm(), 1e-12);  // and not a shift in the plane
  EXPECT_EQ(pass.x[2], 0);                                      // nor a turn about the normal
}

TEST_F(GaussNewtonTest, CutsAStepToTheLongestOneInItsDirection) {
  VERIFIES("LASSO-REG-016~2");
  scan();
  const Pose start = truth();
  const auto step_of = [&](double longest_m, Pose& pose) {
    pose = start;
    Pass pass = equal_rows(Vec3(0.1, 0.2, -0.1), Vec3(0.36, 0.48, 0.8), 0.05, 100);
    Descent descent{longest_m};
    solve_pass(mission_, settings(), descent, pass, pose);
    EXPECT_EQ(pose.p, step_pose(start, descent.last).p);
    return pass.x;
  };
  Pose whole;
  Pose cut;
  const Vec6 x = step_of(kAnyStep, whole);
  const double length_m = x.tail<3>().norm() + mission_.radius_m * x.head<3>().norm();
  ASSERT_GT(length_m, 0.03);
  EXPECT_EQ(step_of(1.01 * length_m, cut), x);
  EXPECT_EQ(cut.p, whole.p);
  EXPECT_EQ(step_of(0.25 * length_m, cut), x);  // the solution stays what it is: a cut step is not convergence
  const Pose quarter = step_pose(start, 0.25 * x);
  EXPECT_LT((cut.p - quarter.p).norm(), 1e-12);
  EXPECT_LT((cut.q.coeffs() - quarter.q.coeffs()).norm(), 1e-12);
}

TEST_F(GaussNewtonTest, SaysWhenThereIsNoSolution) {
  VERIFIES("LASSO-REG-007~2 LASSO-REG-012~1");
  scan();
  const Pose start = truth();
  Pose pose = start;
  const Pass rows = equal_rows(Vec3(0.1, 0.2, -0.1), Vec3(0.6, 0, 0.8), 1e-3, 20);
  // Relative to no noise at all, information has no bound.
  MatchSettings<N> exact = settings();
  exact.reference_variance = N::Variance{0};
  Pass infinite = rows;
  Descent descent;
  solve_pass(mission_, exact, descent, infinite, pose);
  EXPECT_EQ(infinite.status, Status::kNotFinite);
  // A model so large that the turns drown the shifts in rounding.
  mission_.radius_m = 1e12;
  Pass far = rows;
  solve_pass(mission_, settings(), descent, far, pose);
  EXPECT_EQ(descent.last, Vec6(Vec6::Zero()));
  EXPECT_EQ(far.status, Status::kSingular);
  EXPECT_EQ(pose.p, start.p);
  EXPECT_EQ(pose.q.coeffs(), start.q.coeffs());
  take_held_pass(mission_, std::numeric_limits<double>::quiet_NaN() * Vec6::Unit(3), Lookup::kWalk, *workspace_, pose);
  EXPECT_EQ(pose.p, start.p);
}

TEST_F(GaussNewtonTest, SettingsAreTheMissions) {
  VERIFIES("LASSO-REG-003~2");
  scan();
  parameters().kernel_width = 7;
  parameters().incidence_max_rad = 1.1;
  const MatchSettings<N> s = settings(0.03);
  EXPECT_TRUE(test::is_path_number(s.kernel_squared, 49));
  EXPECT_TRUE(test::is_path_number(s.cos_incidence_max, std::cos(1.1)));
  EXPECT_TRUE(test::is_path_number(s.surface_variance, 4e-8));
  EXPECT_TRUE(test::is_path_number(s.reference_variance, 1e-6 + 4e-8));  // the same at every range here
  EXPECT_TRUE(test::is_path_number(s.gate, 0.03));
}

// The largest that a mission may say.
TEST_F(GaussNewtonTest, NoiseOfAPoorSurfaceAddsUp) {
  VERIFIES("LASSO-REG-003~2");
  scan();
  parameters().surface_sigma_m = 1;
  const MatchSettings<N> s = settings();
  EXPECT_GT(s.surface_variance, N::Variance{0});
  EXPECT_GT(s.reference_variance, s.surface_variance);
}

// How many passes a look has, how far their steps go, and which of them ends it.
class LookTest : public test::PoseFixture {
 protected:
  static constexpr int kOpening = 1;        // passes before those over all points
  static constexpr int kCutOpening = 2;     // where the first step was cut
  static constexpr int kFirstPatience = 3;  // passes after which a step within the pose's own uncertainty ends a look
  static constexpr int kSecondPatience = 5;
  static constexpr int kRoughPatience = 6;  // more of them where a step of the opening was cut

  LookTest() { scan_.side = 24; }

  HitSolution register_from(double rotation_rad, double shift_m) {
    return register_hits(mission_, inverse(test::disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_)), *workspace_);
  }

  // Does the first pass, over half of the points, ask for a step that is cut?
  bool is_rough(Pose T_target_sensor) {
    MatchSettings<FlightNumber> settings = make_settings(parameters(), *workspace_);
    set_gate(parameters().gate_first_m, settings);
    const Pass pass = take_pass(mission_, settings, {2, Lookup::kWalk}, *workspace_, T_target_sensor);
    return length_of(pass.x, mission_.radius_m) > longest_step_m(parameters(), settings);
  }
};

// Whatever the limit, of looks that no step ends.
TEST_F(LookTest, EachOfTwoLooksHasAsManyPassesAsTheMissionSets) {
  VERIFIES("LASSO-REG-011~2");
  parameters().stop_translation_m = 0;
  scan_.outliers = 0.2;
  for (const int limit : {1, 2, 3}) {
    parameters().iterations_max = limit;
    for (int i = 0; i < 10; ++i) {
      scan_.sigma_m = i % 2 == 0 ? 1e-3 : 5e-3;
      scan();
      const HitSolution solution = register_from(0.02, 0.02);
      EXPECT_LE(solution.iterations, 2 * (kCutOpening + limit)) << limit;
      EXPECT_GE(solution.iterations, kOpening + 1 + kOpening + 1) << limit;
    }
    EXPECT_LE(register_look(mission_, RegisterLook::kSecond, truth(), *workspace_).iterations, kCutOpening + limit);
  }
}

// Far off along the boresight, within the kernel: the noise-free points ask for the whole way at once, in each pass.
TEST_F(LookTest, NoStepGoesFartherThanTheGateOrTheNoiseOfAReturn) {
  VERIFIES("LASSO-REG-016~2");
  parameters().iterations_max = 1;
  scan();
  Pose start = scan_.T_sensor_target;
  start.p[2] += 7e-3;
  const double noise_m = std::hypot(parameters().sigma0_m, parameters().surface_sigma_m);
  for (const double gate_m : {1e-6, 1.2e-3}) {
    parameters().gate_first_m = gate_m;
    const double longest_m = std::max(gate_m, noise_m);
    const auto moved_m = [&](RegisterLook look) {
      return (inverse(register_look(mission_, look, inverse(start), *workspace_).T_target_sensor).p - start.p).norm();
    };
    // Two passes that open a look, and one more; those of the second look may go twice as far.
    EXPECT_LE(moved_m(RegisterLook::kFirst), 3.001 * longest_m) << gate_m;
    EXPECT_GE(moved_m(RegisterLook::kFirst), 2.8 * longest_m) << gate_m;
    EXPECT_LE(moved_m(RegisterLook::kSecond), 5.001 * longest_m) << gate_m;
    EXPECT_GE(moved_m(RegisterLook::kSecond), 4.6 * longest_m) << gate_m;
  }
}

// A look of a search goes on where one of an estimate is content with the pose's own uncertainty: the passes of both tell where that
// begins.
TEST_F(LookTest, ThePosesOwnUncertaintyCountsFromItsPassOn) {
  VERIFIES("LASSO-REG-020~2");
  scan_.sigma_m = 1e-3;
  int first_pass = 1000, second_pass = 1000, rough_pass = 1000;
  for (int i = 0; i < 250; ++i) {
    scan_.outliers = i % 2 == 0 ? 0.05 : 0;
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.008, 0.006, random_));
    const auto passes_of = [&](RegisterLook look) { return register_look(mission_, look, start, *workspace_).iterations; };
    const int first = register_first(mission_, start, *workspace_).iterations;
    const int both = register_hits(mission_, start, *workspace_).iterations;
    if (first < passes_of(RegisterLook::kFirst)) first_pass = std::min(first_pass, first);
    if (both > first && both < first + passes_of(RegisterLook::kSecond)) second_pass = std::min(second_pass, both);
    start = inverse(test::disturb(scan_.T_sensor_target, 0.03, 0.02, random_));
    const int rough = register_first(mission_, start, *workspace_).iterations;
    if (rough < passes_of(RegisterLook::kFirst) && is_rough(start)) rough_pass = std::min(rough_pass, rough);
  }
  EXPECT_EQ(first_pass, kFirstPatience + 1);
  EXPECT_GE(second_pass, kSecondPatience + 1);
  EXPECT_LE(second_pass, kSecondPatience + 2);
  EXPECT_EQ(rough_pass, kFirstPatience + kRoughPatience + 1);
}

}  // namespace
}  // namespace lasso
