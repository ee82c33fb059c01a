#include "mdat/scene/clohessy_wiltshire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mdat/scene/orbit.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

using Kind = ClohessyWiltshire::LegKind;
using Leg = ClohessyWiltshire::Leg;

const double kN = Orbit({400e3, 0, 0}).mean_motion_radps();

// Step by step with Runge and Kutta's method, of any equation of motion.
template <class Acceleration>
RelativeState integrated(RelativeState state, double t_s, int steps, Acceleration acceleration) {
  const double h = t_s / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec3 p = state.p_m, v = state.v_mps;
    const Vec3 a1 = acceleration(p, v);
    const Vec3 v2 = v + h / 2 * a1, a2 = acceleration(p + h / 2 * v, v2);
    const Vec3 v3 = v + h / 2 * a2, a3 = acceleration(p + h / 2 * v2, v3);
    const Vec3 v4 = v + h * a3, a4 = acceleration(p + h * v3, v4);
    state.p_m += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    state.v_mps += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return state;
}

TEST(Drift, SolvesTheEquationsOfClohessyAndWiltshire) {
  VERIFIES("LASSO-SCN-011~1");
  const auto equations = [](const Vec3& p, const Vec3& v) {
    return Vec3(3 * kN * kN * p.x() + 2 * kN * v.y(), -2 * kN * v.x(), -kN * kN * p.z());
  };
  test::Generator random(71);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 p = random_vector(random, 50);
    const RelativeState begin{p, random_vector(random, 0.05)};
    const double t_s = random.uniform(-9000, 9000);
    const RelativeState found = drift(begin, kN, t_s), expected = integrated(begin, t_s, 3000, equations);
    ASSERT_NEAR((found.p_m - expected.p_m).norm(), 0, 1e-6);
    ASSERT_NEAR((found.v_mps - expected.v_mps).norm(), 0, 1e-9);
  }
}

// Two bodies about the Earth by Newton's law: what the equations leave out goes with the square of the distance.
TEST(Drift, IsTheRelativeMotionOfTwoOrbits) {
  VERIFIES("LASSO-SCN-011~1");
  const double radius_m = kEarthRadius_m + 400e3;
  const auto newton = [](const Vec3& p, const Vec3&) { return Vec3(-kEarthGravity_m3ps2 / std::pow(p.norm(), 3) * p); };
  const double t_s = 1700;
  const auto error_m = [&](double scale) {
    const RelativeState begin{scale * Vec3(12, -30, 7), scale * Vec3(0.011, 0.006, -0.02)};
    const Vec3 omega(0, 0, kN);
    const Vec3 target(radius_m, 0, 0), chaser = target + begin.p_m;
    const RelativeState far = integrated({chaser, begin.v_mps + omega.cross(chaser)}, t_s, 4000, newton);
    const Mat3 hill = Eigen::AngleAxisd(kN * t_s, Vec3::UnitZ()).toRotationMatrix();
    return (hill.transpose() * far.p_m - target - drift(begin, kN, t_s).p_m).norm();
  };
  EXPECT_LT(error_m(1), 2e-3);
  EXPECT_NEAR(error_m(20) / error_m(10), 4, 0.2);
}

TEST(ClohessyWiltshire, ATransferMeetsItsWayPoints) {
  VERIFIES("LASSO-SCN-011~1");
  test::Generator random(72);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 a = random_vector(random, 100), b = random_vector(random, 100), c = random_vector(random, 100);
    const double first_s = random.uniform(100, 2500), second_s = random.uniform(100, 2500);
    const ClohessyWiltshire motion({kN, a, {{Kind::kTransfer, first_s, b}, {Kind::kHold, 60, {}}, {Kind::kTransfer, second_s, c}}});
    const auto at = [&](double t_s) { return motion.at(std::llround(1e6 * t_s)); };
    ASSERT_NEAR((at(0).T_a_b.p - a).norm(), 0, 1e-9);
    ASSERT_NEAR((at(first_s).T_a_b.p - b).norm(), 0, 1e-5) << "within a microsecond";
    ASSERT_NEAR((at(first_s - 1e-6).T_a_b.p - b).norm(), 0, 1e-4);
    ASSERT_EQ(at(first_s + 30).T_a_b.p, b);
    ASSERT_EQ(at(first_s + 30).rates.v_mps, Vec3::Zero());
    ASSERT_EQ(at(first_s + 60 + second_s + 1e-6).T_a_b.p, c);
    ASSERT_EQ(at(first_s + 1e7).T_a_b.p, c);
    ASSERT_EQ(at(-500).T_a_b.p, a);
    ASSERT_EQ(at(-500).rates.v_mps, Vec3::Zero());
    ASSERT_LT(rate_error(motion, std::llround(1e6 * first_s * 0.4)), 1e-8);
    ASSERT_EQ(at(77).T_a_b.q.coeffs(), Quat::Identity().coeffs());
  }
}

// Along V-bar by radial impulses takes half a revolution, and n/4 of the way a second; by tangential ones a whole revolution (Fehse,
// Automated Rendezvous and Docking of Spacecraft, 3.3). Half and whole revolutions are where parts of a transfer have no solution.
TEST(ClohessyWiltshire, KnowsTheClassicTransfers) {
  VERIFIES("LASSO-SCN-011~1");
  const double half_s = M_PI / kN;
  const ClohessyWiltshire hop({kN, Vec3(0, -100, 0), {{Kind::kTransfer, half_s, Vec3(0, -20, 0)}}});
  EXPECT_NEAR(std::fabs(hop.at(1).rates.v_mps.x()), kN / 4 * 80, 1e-6);
  EXPECT_NEAR(hop.at(1).rates.v_mps.y(), 0, 1e-6);
  EXPECT_NEAR(hop.at(std::llround(0.5e6 * half_s)).T_a_b.p.y(), -60, 1e-6);
  const ClohessyWiltshire loop({kN, Vec3::Zero(), {{Kind::kDrift, 2 * half_s, Vec3(0, 0.05, 0)}}});
  EXPECT_NEAR(loop.at(std::llround(2e6 * half_s)).T_a_b.p.y(), -6 * M_PI / kN * 0.05, 1e-5);
  EXPECT_NEAR(loop.at(std::llround(1e6 * half_s)).T_a_b.p.x(), 4 / kN * 0.05, 1e-5);
  const std::string remedy =
      " revolutions: no two impulses reach the way point in this time: choose another duration, such as a third of a revolution";
  EXPECT_EQ(problems_of([&] {
              ClohessyWiltshire({kN, Vec3(0, 9, 1), {{Kind::kTransfer, half_s, Vec3(0, 1, 1)}}});
            }),
            "scene: leg 1, duration: 0.5" + remedy);
  const std::string whole = problems_of([&] { ClohessyWiltshire({kN, Vec3(0, 9, 0), {{Kind::kTransfer, 2 * half_s, Vec3(0, 1, 0)}}}); });
  EXPECT_NE(whole.find("no two impulses"), std::string::npos) << whole;
}

TEST(ClohessyWiltshire, ADriftGoesOnAndCameFromBefore) {
  VERIFIES("LASSO-SCN-011~1");
  const RelativeState begin{Vec3(3, -40, 2), Vec3(0.01, 0.02, -0.03)};
  const ClohessyWiltshire alone({kN, begin.p_m, {{Kind::kDrift, 100, begin.v_mps}}});
  for (const double t_s : {-4000.0, 0.0, 99.0, 5000.0}) {
    const MotionState now = alone.at(std::llround(1e6 * t_s));
    EXPECT_NEAR((now.T_a_b.p - drift(begin, kN, t_s).p_m).norm(), 0, 1e-9);
    EXPECT_NEAR((now.rates.v_mps - drift(begin, kN, t_s).v_mps).norm(), 0, 1e-12);
    EXPECT_LT(rate_error(alone, std::llround(1e6 * t_s)), 1e-8);
  }
  const ClohessyWiltshire held({kN, begin.p_m, {{Kind::kHold, 100, {}}, {Kind::kDrift, 50, begin.v_mps}, {Kind::kHold, 1, {}}}});
  EXPECT_EQ(held.at(-7).T_a_b.p, begin.p_m);
  EXPECT_NEAR((held.at(130'000'000).T_a_b.p - drift(begin, kN, 30).p_m).norm(), 0, 1e-9);
  EXPECT_NEAR((held.at(999'000'000).T_a_b.p - drift(begin, kN, 50).p_m).norm(), 0, 1e-9);
  EXPECT_EQ(ClohessyWiltshire({kN, begin.p_m, {}}).at(5).T_a_b.p, begin.p_m);
}

TEST(ClohessyWiltshire, SaysAllThatIsWrongWithAPlan) {
  VERIFIES("LASSO-SCN-003~1");
  const ClohessyWiltshire::Setup setup{
      0, Vec3(kNan, 0, 0), {{Kind::kHold, 0, {}}, {Kind::kDrift, -1, Vec3(0, kNan, 0)}, {Kind::kHold, 1, {}}}};
  EXPECT_EQ(
      problems_of([&] {
        ClohessyWiltshire motion(setup, {"plan.toml", 4, 2});
      }),
      "plan.toml:4:2: leg 1, duration: 0 s: expected more than 0 s\nplan.toml:4:2: leg 2: expected finite numbers\n"
      "plan.toml:4:2: leg 2, duration: -1 s: expected more than 0 s\nplan.toml:4:2: mean motion: 0 rad/s: expected more than 0 rad/s\n"
      "plan.toml:4:2: start: expected finite numbers");
}

}  // namespace
}  // namespace lasso::mdat::scene
