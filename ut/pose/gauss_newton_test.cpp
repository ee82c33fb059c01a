// The passes, and the matching of single points in match.hpp and scan_sums.hpp that they are made of.
#include "fsw/pose/gauss_newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fsw/pose/unseen.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Point = MatchPoint<N>;

// A measured point and the box, in double: where along its ray the box's front is met, and on which face.
struct Met {
  bool met = false;
  bool clear = false;  // not at an edge of a face, where rounding decides
  double t = 0;        // m, from the point along its ray
  Vec3 m = Vec3::Zero(), u = Vec3::Zero(), n = Vec3::Zero();
  double residual() const { return t * n.dot(u); }
  Vec3 q() const { return m + t * u; }
};

Met meet(const test::BoxModel& box, const Pose& T_target_sensor, const Point& point) {
  Met met;
  met.m = T_target_sensor * to_vec3(point.p);
  met.u = rotate(T_target_sensor.q, to_vec3(point.u));
  const double range = test::cast_box(box, met.m - 10 * met.u, met.u);
  met.met = range > 0;
  met.t = range - 10;
  Vec3 depth = (met.m + met.t * met.u - box.center).cwiseAbs() - box.half;  // 0 for the face's own axis
  int axis = 0;
  (void)depth.maxCoeff(&axis);
  met.n[axis] = met.u[axis] < 0 ? 1 : -1;
  depth[axis] = -1;
  met.clear = !met.met || depth.maxCoeff() < -1e-3;
  return met;
}

// A pass over every stride-th point by brute force, in double.
struct BruteSums {
  Mat6 H = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  double chi_squared = 0, squared_range = 0;
  std::uint32_t count = 0, usable = 0;
};

struct BruteSettings {
  double width, surface2, reference2, cos_incidence_max, gate;
};

void add_brute(const BruteSettings& s, const Point& point, const Met& met, BruteSums& sums) {
  const double tilt = met.n.dot(met.u);
  if (met.met && std::abs(met.t) < static_cast<double>(point.reach) + 3 * s.gate && std::abs(tilt) < s.cos_incidence_max) return;
  ++sums.usable;
  if (!met.met || std::abs(met.t) > static_cast<double>(point.reach) + 3 * s.gate) return;
  const double variance =
      tilt * tilt * static_cast<double>(point.range_variance) + (1 - tilt * tilt) * static_cast<double>(point.across_variance) + s.surface2;
  const double r = met.residual();
  const double limit = s.width * s.width * variance + s.gate * s.gate;
  if (r * r >= limit) return;
  const double weight = std::pow(1 - r * r / limit, 2) / variance;
  Vec6 J;
  J << met.q().cross(met.n), met.n;
  sums.H += weight * J * J.transpose();
  sums.b += weight * r * J;
  sums.chi_squared += weight * r * r;
  sums.squared_range += met.t * met.t;
  ++sums.count;
}

class GaussNewtonTest : public test::PoseFixture {
 protected:
  GaussNewtonTest() {
    scan_.side = 20;
    scan_.sigma_m = 1e-3;
    parameters().sigma_angle_rad = 3e-4;
    parameters().surface_sigma_m = 2e-4;
  }

  MatchSettings<N> settings(double gate_m = 0) {
    MatchSettings<N> s = make_settings(parameters(), *workspace_);
    set_gate(gate_m, s);
    return s;
  }

  Span<Point> points() { return {workspace_->points.begin(), workspace_->points.size()}; }

  // Leaves the points out that an edge of the box could push to either side.
  void keep_clear_points(const Pose& pose) {
    keep_points([&](std::size_t, const Point& point) { return meet(scan_.model, pose, point).clear; });
  }

  BruteSums brute(const Pose& pose, double gate_m, std::size_t stride) const {
    const MissionParameters& p = mission_.parameters;
    const double surface2 = p.surface_sigma_m * p.surface_sigma_m;
    const auto reference2 = static_cast<double>(workspace_->points[workspace_->points.size() / 2].range_variance) + surface2;
    const BruteSettings s{p.kernel_width, surface2, reference2, std::cos(p.incidence_max_rad), gate_m};
    BruteSums sums;
    for (std::size_t i = 0; i < workspace_->points.size(); i += stride) {
      add_brute(s, workspace_->points[i], meet(scan_.model, pose, workspace_->points[i]), sums);
    }
    return sums;
  }

  // The mean over the points that count.
  double brute_bounded(const Pose& pose) const {
    const MissionParameters& p = mission_.parameters;
    double cost = 0;
    int usable = 0;
    for (const Point& point : workspace_->points) {
      const Met met = meet(scan_.model, pose, point);
      const bool hit = met.met && std::abs(met.t) < static_cast<double>(point.reach);
      const double tilt = met.n.dot(met.u);
      if (hit && std::abs(tilt) < std::cos(p.incidence_max_rad)) continue;
      ++usable;
      const double variance = tilt * tilt * static_cast<double>(point.range_variance) +
                              (1 - tilt * tilt) * static_cast<double>(point.across_variance) + p.surface_sigma_m * p.surface_sigma_m;
      const double share = hit ? std::min(1.0, met.residual() * met.residual() / (3 * kMostOfAReturn * variance)) : 1;
      cost += kMostOfAReturn * (1 - std::pow(1 - share, 3));
    }
    return cost / usable;
  }

  void expect_sums(const PassSums<N>& sums, const BruteSums& truth, double reference_variance) const {
    Mat6 H;
    Vec6 b;
    sums.rows.unpack(H, b);
    H /= reference_variance;
    b /= reference_variance;
    EXPECT_EQ(sums.rows.count(), truth.count);
    EXPECT_EQ(sums.usable, truth.usable);
    const double size = std::sqrt(truth.chi_squared);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) EXPECT_NEAR(H(i, j), truth.H(i, j), 1e-3 * std::sqrt(truth.H(i, i) * truth.H(j, j)));
      EXPECT_NEAR(b[i], truth.b[i], 1e-3 * std::sqrt(truth.H(i, i)) * size);
    }
    EXPECT_NEAR(sums.rows.chi_squared() / reference_variance, truth.chi_squared, 1e-3 * truth.chi_squared);
    EXPECT_NEAR(sums.rows.squared_range(), truth.squared_range, 1e-3 * truth.squared_range);
  }
};

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

// Tukey's rho with a kernel of sqrt(12) sigmas, point by point in double.
TEST_F(GaussNewtonTest, TheBoundedCostIsThatOfABruteForcePass) {
  VERIFIES("LASSO-REG-031~1");
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    parameters().incidence_max_rad = i % 2 == 0 ? 0.9 : 1.5;
    scan();
    const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.001, 0.001, random_));
    keep_clear_points(pose);
    const double bounded = brute_bounded(pose);
    ASSERT_GT(bounded, 0);
    ASSERT_LT(bounded, kMostOfAReturn);
    EXPECT_NEAR(bounded_cost(mission_, pose, 20, *workspace_), 20 * bounded, 0.01);
  }
}

TEST_F(GaussNewtonTest, WithoutAReturnTheBoundedCostIsMoreThanAny) {
  VERIFIES("LASSO-REG-031~1");
  scan();
  Pose behind = truth();
  behind.p *= -20;
  EXPECT_EQ(bounded_cost(mission_, behind, 7, *workspace_), 7 * kMostOfAReturn) << "all are left out";
  const auto count = static_cast<double>(workspace_->points.size());
  EXPECT_EQ(bounded_cost(mission_, behind, 2 * count, *workspace_), 2 * count * kMostOfAReturn);
  EXPECT_GT(bounded_cost(mission_, behind, 2.01 * count, *workspace_), 1e200) << "fewer than half of those of the registration";
  for (MatchPoint<N>& point : workspace_->points) point.aimed = true;
  EXPECT_GT(bounded_cost(mission_, behind, 7, *workspace_), 1e200) << "those at a contour may well be";
  workspace_->points.clear();
  EXPECT_GT(bounded_cost(mission_, truth(), 7, *workspace_), 1e200);
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
  VERIFIES("LASSO-REG-007~1");
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

// Against the least squares over the five directions that are left, in double, of brute-force sums.
TEST_F(GaussNewtonTest, AHeldAxisStaysAndTheOthersAreSolved) {
  VERIFIES("LASSO-REG-031~1");
  scan();
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.004, 0.003, random_));
  keep_clear_points(start);
  const BruteSums sums = brute(start, 0, 1);
  for (const double radius_m : {mission_.radius_m, mission_.radius_m, 6.0, 30.0}) {
    mission_.radius_m = radius_m;
    parameters().gate_first_m = radius_m;  // no step is cut
    const Vec6 axis = test::random_vec6(random_, 1).normalized();
    const Vec6 row = axis.cwiseProduct(radius_scale(radius_m));
    const Eigen::Matrix<double, 6, 5> free = Eigen::FullPivLU<Eigen::Matrix<double, 1, 6>>(row.transpose()).kernel();
    const Vec6 x = free * (free.transpose() * sums.H * free).ldlt().solve(free.transpose() * sums.b);
    Pose pose = start;
    take_held_pass(mission_, axis, *workspace_, pose);
    const Pose expected = step_pose(start, x);
    EXPECT_LT(pose_difference(pose, expected).norm(), 5e-3 * x.norm()) << radius_m;
  }
  parameters().gate_first_m = 1e-3;
  Pose cut = start;
  take_held_pass(mission_, Vec6::Unit(0), *workspace_, cut);
  EXPECT_NEAR(length_of(pose_difference(cut, start), mission_.radius_m), longest_step_m(parameters(), settings()), 1e-4);
  keep_first_points(kMinimumPoints - 1);
  Pose pose = start;
  take_held_pass(mission_, Vec6::Unit(0), *workspace_, pose);
  EXPECT_EQ(pose.p, start.p);
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
  VERIFIES("LASSO-REG-008~1");
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
  VERIFIES("LASSO-REG-016~1");
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
  VERIFIES("LASSO-REG-007~1 LASSO-REG-012~1");
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
  take_held_pass(mission_, std::numeric_limits<double>::quiet_NaN() * Vec6::Unit(3), *workspace_, pose);
  EXPECT_EQ(pose.p, start.p);
}

TEST_F(GaussNewtonTest, SettingsAreTheMissions) {
  VERIFIES("LASSO-REG-003~1");
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
  VERIFIES("LASSO-REG-003~1");
  scan();
  parameters().surface_sigma_m = 1;
  const MatchSettings<N> s = settings();
  EXPECT_GT(s.surface_variance, N::Variance{0});
  EXPECT_GT(s.reference_variance, s.surface_variance);
}

}  // namespace
}  // namespace lasso
