#include "mdat/scene/torque_free.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

using State = Eigen::Matrix<double, 7, 1>;  // quaternion x y z w, angular velocity in the node's axes

// Euler's equations and the quaternion's, integrated by the classical Runge-Kutta method.
State derivative(const State& state, const Vec3& inertia) {
  const Quat q(state[3], state[0], state[1], state[2]);
  const Vec3 omega = state.tail<3>();
  const Quat rate = q * Quat(0, omega.x(), omega.y(), omega.z());
  State result;
  result << 0.5 * rate.x(), 0.5 * rate.y(), 0.5 * rate.z(), 0.5 * rate.w(),
      -omega.cross(inertia.cwiseProduct(omega)).cwiseQuotient(inertia);
  return result;
}

State integrated(const TorqueFree::Setup& setup, double t_s, int steps) {
  State state;
  state << setup.T_parent_node.q.coeffs(), setup.omega_node_radps;
  const double h = t_s / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = derivative(state, setup.inertia), k2 = derivative(state + h / 2 * k1, setup.inertia);
    const State k3 = derivative(state + h / 2 * k2, setup.inertia), k4 = derivative(state + h * k3, setup.inertia);
    state += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return state;
}

// Largest difference of attitude, rad, and angular velocity, rad/s, from the integration.
double difference(const TorqueFree::Setup& setup, double t_s, int steps) {
  const State expected = integrated(setup, t_s, steps);
  const MotionState found = TorqueFree(setup).at(std::llround(1e6 * t_s));
  const Quat q = Quat(expected[3], expected[0], expected[1], expected[2]).normalized();
  const Vec3 omega = rotate(found.T_a_b.q.conjugate(), found.rates.omega_radps);
  return std::max(log_so3(found.T_a_b.q * q.conjugate()).norm(), (omega - Vec3(expected.tail<3>())).norm());
}

// Moments of a box of random density and sides, in any order of the axes.
Vec3 random_inertia(test::Generator& random) {
  const Vec3 side2(random.uniform(0.1, 4), random.uniform(0.1, 4), random.uniform(0.1, 4));
  return 30 * Vec3(side2.y() + side2.z(), side2.z() + side2.x(), side2.x() + side2.y());
}

TorqueFree::Setup random_setup(test::Generator& random) {
  const Pose pose = random_pose(random, 2);
  const Vec3 omega = random_vector(random, 0.6);
  return {pose, omega, random_inertia(random)};
}

TEST(TorqueFree, IsWhatEulersEquationsIntegrateTo) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(51);
  for (int trial = 0; trial < 40; ++trial) {
    const TorqueFree::Setup setup = random_setup(random);
    const double t_s = std::round(random.uniform(-30, 30) * 1e3) / 1e3;
    ASSERT_LT(difference(setup, t_s, 12000), 1e-9) << trial;
  }
}

// The telescope and rates of a free tumble, and bodies next to symmetric ones, and next to the state that parts both kinds of tumbling.
TEST(TorqueFree, HoldsNextToItsLimits) {
  VERIFIES("LASSO-SCN-007~1");
  const Pose pose{exp_so3(Vec3(0.3, -1, 2)), Vec3(1, 2, 3)};
  const Vec3 tumble = Vec3(0.2, 0.05, 2.0) * (M_PI / 180);
  EXPECT_LT(difference({pose, tumble, Vec3(36e3, 87e3, 94e3)}, 400, 40000), 1e-9);
  for (const Vec3& inertia : {Vec3(1, 2, 2 + 1e-9), Vec3(2 + 1e-9, 2, 1), Vec3(1, 1, 1 + 1e-12), Vec3(1, 2, 3), Vec3(3, 2, 1)}) {
    EXPECT_LT(difference({pose, Vec3(0.5, -0.7, 0.4), inertia}, 20, 20000), 1e-9) << inertia.transpose();
    EXPECT_LT(difference({pose, Vec3(1e-9, 0.8, 1e-7), inertia}, 20, 20000), 1e-8) << inertia.transpose();
    EXPECT_LT(difference({pose, Vec3(-1e-20, 0, 0.9), inertia}, 20, 20000), 1e-9) << inertia.transpose();
  }
  const double parting = std::sqrt(3.0 * (3 - 2) / (1.0 * (2 - 1)));  // of the first rate to the third one, where 2 E I2 = L^2
  for (const double excess : {0.0, 1e-15, -1e-15, 1e-9, -1e-9}) {
    EXPECT_LT(difference({pose, Vec3(0.3 * parting * (1 + excess), 0.4, 0.3), Vec3(1, 2, 3)}, 12, 20000), 1e-8) << excess;
  }
}

TEST(TorqueFree, KeepsEnergyAndAngularMomentumOverDays) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(52);
  for (int trial = 0; trial < 20; ++trial) {
    const TorqueFree::Setup setup = random_setup(random);
    const TorqueFree motion(setup);
    const Vec3 momentum = rotate(setup.T_parent_node.q, setup.inertia.cwiseProduct(setup.omega_node_radps));
    const double energy = setup.omega_node_radps.dot(setup.inertia.cwiseProduct(setup.omega_node_radps));
    for (int i = 0; i < 10; ++i) {
      const MotionState now = motion.at(random_time_us(random, -3e5, 3e5));
      const Vec3 omega = rotate(now.T_a_b.q.conjugate(), now.rates.omega_radps);
      ASSERT_NEAR(omega.dot(setup.inertia.cwiseProduct(omega)) / energy, 1, 1e-12);
      ASSERT_NEAR((rotate(now.T_a_b.q, setup.inertia.cwiseProduct(omega)) - momentum).norm() / momentum.norm(), 0, 1e-12);
      ASSERT_EQ(now.T_a_b.p, setup.T_parent_node.p);
    }
  }
}

TEST(TorqueFree, TurnsByItsOwnRates) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(53);
  for (int trial = 0; trial < 40; ++trial) {
    const TorqueFree motion(random_setup(random));
    ASSERT_LT(rate_error(motion, random_time_us(random, -1000, 1000)), 1e-8) << trial;
  }
}

// In closed form: the axis of symmetry goes round the angular momentum at L / I, and the body about the axis at (1 - Is / I) of its spin.
TEST(TorqueFree, OfASymmetricTopIsARegularPrecession) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(54);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double along : {0.6, 1.7}) {  // a rod, a disc
      TorqueFree::Setup setup = random_setup(random);
      setup.inertia = Vec3::Ones();
      setup.inertia[axis] = along;
      const TorqueFree motion(setup);
      const Vec3 momentum = rotate(setup.T_parent_node.q, setup.inertia.cwiseProduct(setup.omega_node_radps));
      const double t_s = 47.25;
      const double spin_radps = (1 - along) * setup.omega_node_radps[axis];
      const Mat3 expected = Eigen::AngleAxisd(momentum.norm() * t_s, momentum.normalized()).toRotationMatrix() *
                            setup.T_parent_node.q.toRotationMatrix() *
                            Eigen::AngleAxisd(spin_radps * t_s, Vec3::Unit(axis)).toRotationMatrix();
      EXPECT_NEAR((motion.at(47'250'000).T_a_b.q.toRotationMatrix() - expected).norm(), 0, 1e-12) << axis;
    }
  }
}

TEST(TorqueFree, SpinsForEverAboutAPrincipalAxisAndStandsStillWithoutRates) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(55);
  TorqueFree::Setup setup = random_setup(random);
  for (int axis = 0; axis < 4; ++axis) {
    setup.omega_node_radps = axis < 3 ? Vec3(0.4 * Vec3::Unit(axis)) : Vec3(Vec3::Zero());
    const MotionState later = TorqueFree(setup).at(1'000'000'000);
    const Mat3 turn = axis < 3 ? Eigen::AngleAxisd(400, Vec3::Unit(axis)).toRotationMatrix() : Mat3::Identity();
    EXPECT_NEAR((later.T_a_b.q.toRotationMatrix() - setup.T_parent_node.q.toRotationMatrix() * turn).norm(), 0, 1e-12);
  }
}

// Half a flip of a body that turns almost about its middle axis takes K(m) / pace, in closed form near m = 1.
TEST(TorqueFree, FlipsWhenItSpinsAboutItsMiddleAxis) {
  VERIFIES("LASSO-SCN-007~1");
  const TorqueFree motion({Pose{}, Vec3(0, 1, 1e-6), Vec3(1, 2, 3)});
  const double grows_radps = std::sqrt((3.0 - 2) * (2.0 - 1) / (1.0 * 3.0));
  const double flip_s = std::log(4 / (1e-6 * std::sqrt(3 * (3 - 1) / (2.0 * (2 - 1))))) * 2 / grows_radps;
  const MotionState before = motion.at(0), after = motion.at(std::llround(1e6 * flip_s));
  EXPECT_NEAR(rotate(before.T_a_b.q.conjugate(), before.rates.omega_radps).y(), 1, 1e-9);
  EXPECT_NEAR(rotate(after.T_a_b.q.conjugate(), after.rates.omega_radps).y(), -1, 1e-6);
}

TEST(TorqueFree, RefusesWhatNoBodyIs) {
  VERIFIES("LASSO-SCN-003~1");
  EXPECT_EQ(problems_of([] {
              TorqueFree({Pose{}, Vec3::UnitX(), Vec3(1, 2, 4)});
            }),
            "scene: inertia: 4: is more than the two other moments together, which no body has: correct the moments of inertia");
  EXPECT_EQ(problems_of([] {
              TorqueFree({{Quat(2, 0, 0, 0), Vec3::Zero()}, Vec3(kNan, 0, 0), Vec3(1, 0, 1)});
            }),
            "scene: angular velocity: expected finite numbers\nscene: inertia: expected three positive moments of inertia\n"
            "scene: pose: is not a pose: expected finite numbers and a quaternion of unit length");
  EXPECT_EQ(problems_of([] { TorqueFree({Pose{}, Vec3::UnitX(), Vec3(1, 1, 2)}); }), "") << "a thin plate";
}

}  // namespace
}  // namespace lasso::mdat::scene
