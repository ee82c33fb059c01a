#include "mdat/scene/attitude_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

Pointing random_pointing(test::Generator& random) {
  const Vec3 axis = random_vector(random, 1).normalized(), up = random_vector(random, 1).normalized();
  return {axis, up, random_vector(random, 1).normalized()};
}

// The axis lies on the way, and the way, the node's up and the reference in one half plane: so the roll is the nearest one.
void expect_points(const Pointing& pointing, const Quat& q, const Vec3& way) {
  const Vec3 unit = way.normalized(), up = q * pointing.up_node;
  EXPECT_NEAR((q * pointing.axis_node - unit).norm(), 0, 1e-12);
  EXPECT_NEAR(unit.cross(pointing.up_base).dot(up), 0, 1e-12);
  EXPECT_GT(unit.cross(pointing.up_base).dot(unit.cross(up)), 0);
}

TEST(PointAlong, BringsTheAxisOntoAWayThatMovesAndTheRollToItsReference) {
  VERIFIES("LASSO-SCN-012~1");
  test::Generator random(81);
  for (int trial = 0; trial < 50; ++trial) {
    const Pointing pointing = random_pointing(random);
    const Vec3 from = random_vector(random, 3), speed = random_vector(random, 0.2);
    const auto at = [&](TimeUs t_us) { return point_along(pointing, from + to_seconds(t_us) * speed, speed); };
    const TimeUs t_us = random_time_us(random, -5, 5);
    expect_points(pointing, at(t_us).T_a_b.q, from + to_seconds(t_us) * speed);
    const Twist expected = difference_rates([&](TimeUs t) { return at(t).T_a_b; }, t_us, 300);
    ASSERT_NEAR((at(t_us).rates.omega_radps - expected.omega_radps).norm() / (1 + expected.omega_radps.norm()), 0, 1e-7) << trial;
  }
}

TEST(PointAlong, HasAnAttitudeWhereTheRollReferenceSaysNothing) {
  VERIFIES("LASSO-SCN-012~1");
  const Pointing pointing;
  for (const Vec3& way : {Vec3(0, 0, 2), Vec3(0, 1e-8, -2), Vec3(0, 0, 0)}) {
    const MotionState state = point_along(pointing, way, Vec3(0.1, 0, 0));
    EXPECT_TRUE(is_valid(state.T_a_b));
    EXPECT_TRUE(state.rates.omega_radps.allFinite());
    if (way.z() != 0) {
      EXPECT_NEAR((state.T_a_b.q * pointing.axis_node - way.normalized()).norm(), 0, 1e-12);
    }
  }
}

// In axes that do not turn, by the orbit's angle.
TEST(InertialAttitude, StandsStillWhileTheOrbitTurns) {
  VERIFIES("LASSO-SCN-012~1");
  test::Generator random(82);
  const Orbit orbit({400e3, 0.4, 0.7});
  const Quat q = random_attitude(random);
  const ConstantRates law = inertial_attitude(orbit, q);
  for (int trial = 0; trial < 20; ++trial) {
    const TimeUs t_us = random_time_us(random, -1e4, 1e4);
    const Mat3 turned = Eigen::AngleAxisd(orbit.mean_motion_radps() * to_seconds(t_us), Vec3::UnitZ()).toRotationMatrix();
    ASSERT_NEAR((turned * law.at(t_us).T_a_b.q.toRotationMatrix() - q.toRotationMatrix()).norm(), 0, 1e-12);
    const Vec3 omega_inertial = law.at(t_us).rates.omega_radps + Vec3(0, 0, orbit.mean_motion_radps());
    ASSERT_EQ(omega_inertial, Vec3::Zero());
    ASSERT_NEAR((law.at(t_us).T_a_b.q.conjugate() * orbit.sun_hill(t_us) - q.conjugate() * orbit.sun_hill(0)).norm(), 0, 1e-12)
        << "the Sun is where it was";
  }
}

TEST(SunPointing, KeepsItsAxisOnTheSun) {
  VERIFIES("LASSO-SCN-012~1");
  test::Generator random(83);
  for (const double beta : {-1.1, 0.0, 0.5}) {
    const Orbit orbit({400e3, beta, 0.7});
    Pointing pointing = random_pointing(random);
    pointing.up_base = Vec3::UnitZ();
    const SunPointing law(orbit, pointing);
    for (int trial = 0; trial < 20; ++trial) {
      const TimeUs t_us = random_time_us(random, -1e4, 1e4);
      expect_points(pointing, law.at(t_us).T_a_b.q, orbit.sun_hill(t_us));
      ASSERT_LT(rate_error(law, t_us, 100000), 1e-9);
      // About the cross-track axis, as the Sun does.
      ASSERT_NEAR((law.at(t_us).rates.omega_radps - Vec3(0, 0, -orbit.mean_motion_radps())).norm(), 0, 1e-12);
    }
  }
}

TEST(SunPointing, RefusesARollReferenceThatMeetsTheSun) {
  VERIFIES("LASSO-SCN-003~1");
  const Orbit orbit({400e3, 0.3, 0});
  const auto problems = [&](const Pointing& pointing) {
    return problems_of([&] { SunPointing law(orbit, pointing, {"sun.toml", 3, 1}); });
  };
  const Vec3 met(std::cos(0.3), 0, std::sin(0.3));
  const std::string meets =
      "sun.toml:3:1: roll reference: meets the Sun's direction, or its opposite, during an orbit: choose another one, such as across the "
      "track";
  EXPECT_EQ(problems({Vec3::UnitX(), Vec3::UnitY(), met}), meets);
  EXPECT_EQ(problems({Vec3::UnitX(), Vec3::UnitY(), Vec3(met.x(), 0, -met.z())}), meets);
  EXPECT_EQ(problems({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()}), "");
  EXPECT_EQ(problems({Vec3(1, 1, 0), Vec3(2, 2, 0), Vec3(0, 0, kNan)}),
            "sun.toml:3:1: axis: is not of unit length: divide it by its length\n"
            "sun.toml:3:1: roll reference: is not of unit length: divide it by its length\n"
            "sun.toml:3:1: up: is not of unit length: divide it by its length\n"
            "sun.toml:3:1: up: lies along the axis: expected another direction of the node, best at right angles");
}

}  // namespace
}  // namespace lasso::mdat::scene
