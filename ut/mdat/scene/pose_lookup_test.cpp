#include "mdat/scene/pose_lookup.hpp"

#include <gtest/gtest.h>

#include "mdat/scene/torque_free.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

// Of a tumbling body 60 m away, seen from a frame that turns: off by at most `rad` and `m`; how many times the exact motion was asked.
int expect_near(double spin_degps, double rad, double m) {
  TorqueFree::Setup setup;
  setup.omega_node_radps = spin_degps * kRadPerDeg * Vec3(0.1, 0.9, 0.4);
  setup.inertia = Vec3(36, 87, 94);
  const TorqueFree tumble(setup);
  ConstantRates::Setup far;
  far.T_parent_pivot.p = Vec3(10, -20, 55);
  far.rates = {Vec3(0, 0.002, 0.001), Vec3(0.1, 0.3, -0.2)};
  const ConstantRates drift(far);
  int asked = 0;
  const auto exact = [&](TimeUs t_us) {
    ++asked;
    return drift.at(t_us) * tumble.at(t_us);
  };
  PoseLookup lookup(exact);
  test::Generator random(17);
  for (int scan = 0; scan < 6; ++scan) {
    const auto begin_us = static_cast<TimeUs>(random.uniform(-1e8, 1e8));
    for (TimeUs t_us = begin_us; t_us < begin_us + 180'000; t_us += 1757) {
      const Pose pose = lookup.at(t_us), truth = (drift.at(t_us) * tumble.at(t_us)).T_a_b;
      EXPECT_LE(log_so3(truth.q.conjugate() * pose.q).norm(), rad);
      EXPECT_LE((truth.p - pose.p).norm(), m);
    }
  }
  return asked;
}

TEST(PoseLookup, IsNearTheExactMotionAndAsksItSeldom) {
  VERIFIES("LASSO-SCN-025~1");
  EXPECT_LT(expect_near(3, 2e-9, 1.2e-7), 6 * 4 * 5 + 1);  // 6 scans of at most 4 intervals, 5 states each
}

TEST(PoseLookup, IsExactWhereTheMotionIsTooFastForIt) {
  VERIFIES("LASSO-SCN-025~1");
  EXPECT_GT(expect_near(700, 1e-14, 1e-13), 600);  // every pose
}

TEST(PoseLookup, SeesJumps) {
  VERIFIES("LASSO-SCN-025~1");
  Steps::Setup setup;
  setup.step_rad = 1e-6;
  setup.T_parent_node.p = Vec3(0, 0, 4);
  const Steps steps(setup);
  PoseLookup lookup([&](TimeUs t_us) { return steps.at(t_us); });
  for (TimeUs t_us = -500'000; t_us < 500'000; t_us += 997) {
    EXPECT_LT(log_so3(steps.at(t_us).T_a_b.q.conjugate() * lookup.at(t_us).q).norm(), 1e-12) << t_us;
  }
}

// Not on what was asked before.
TEST(PoseLookup, DependsOnTheTimeAlone) {
  VERIFIES("LASSO-SCN-025~1");
  TorqueFree::Setup setup;
  setup.omega_node_radps = Vec3(0.02, 0.05, 0.01);
  setup.inertia = Vec3(1, 2, 2.5);
  const TorqueFree tumble(setup);
  const auto exact = [&](TimeUs t_us) { return tumble.at(t_us); };
  PoseLookup one(exact), other(exact);
  static_cast<void>(other.at(12'345));
  for (const TimeUs t_us : {TimeUs{99'999}, TimeUs{40'000}, TimeUs{-3}}) {
    const Pose a = one.at(t_us), b = other.at(t_us);
    EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
    EXPECT_EQ(a.p, b.p);
    static_cast<void>(other.at(t_us + 70'000));
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
