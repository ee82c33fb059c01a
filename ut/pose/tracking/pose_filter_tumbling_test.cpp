// A target that tumbles: its angular velocity wanders without a torque.
#include <algorithm>
#include <cmath>

#include "fsw/pose/tracking/pose_filter.hpp"
#include "ut/pose/filter_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {
namespace {

TEST(FilterTumbling, PrecessionAddsToTheDisturbanceWithTheSquareOfTheRate) {
  VERIFIES("LASSO-FLT-014~1");
  Generator random(41);
  FilterState calm = generic_state(random);
  FilterState precessing = calm;
  const double precession = 0.25 * calm.rates.omega_radps.squaredNorm();
  FilterNoise noise = kNoise;
  noise.angular_acceleration_radps2 = std::hypot(kNoise.angular_acceleration_radps2, precession);
  ASSERT_EQ(predict_filter(calm, calm.t_us + 350'000, noise), Status::kOk);
  noise = kNoise;
  noise.precession = 0.25;
  ASSERT_EQ(predict_filter(precessing, precessing.t_us + 350'000, noise), Status::kOk);
  EXPECT_LT((calm.covariance - precessing.covariance).cwiseAbs().maxCoeff(), 1e-16);
  FilterState resting = calm;
  resting.rates.omega_radps.setZero();
  FilterState without = resting;
  ASSERT_EQ(predict_filter(resting, resting.t_us + 350'000, noise), Status::kOk);
  ASSERT_EQ(predict_filter(without, without.t_us + 350'000, kNoise), Status::kOk);
  EXPECT_EQ(resting.covariance, without.covariance) << "one at rest is disturbed by the other term alone";
}

// A free body by Euler's equations, with the inertia of a slender telescope: its angular velocity wanders though no torque acts.
struct FreeBody {
  Vec3 inertia{1, 7, 6.5};
  Vec3 momentum;  // does not change
  Truth truth;

  Vec3 omega() const { return truth.pose.q * (truth.pose.q.conjugate() * momentum).cwiseQuotient(inertia); }
  void move(double dt) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 before = omega();
      Truth half = truth;
      half.pose.q = turn(0.5 * dt / 200 * before) * half.pose.q;
      const Vec3 middle = half.pose.q * (half.pose.q.conjugate() * momentum).cwiseQuotient(inertia);
      truth.pose.q = (turn(dt / 200 * middle) * truth.pose.q).normalized();
    }
    truth.rates.omega_radps = omega();
  }
};

TEST(FilterTumbling, ATumblingBodyIsFollowedWithinItsSigmas) {
  VERIFIES("LASSO-FLT-014~1");
  Generator random(42);
  double nees = 0;
  int count = 0;
  double most = 0;  // of angular acceleration, over omega^2
  for (int run = 0; run < 20; ++run) {
    FreeBody body;
    body.truth.pose = generic_start(random).T_sensor_target;
    body.momentum = normals<Vec3>(random);
    body.momentum *= 0.17 / body.omega().norm();  // 10 deg/s
    body.truth.rates.omega_radps = body.omega();
    FilterStart start = generic_start(random);
    start.T_sensor_target = body.truth.pose;
    start.rates = body.truth.rates;
    FilterState state;
    ASSERT_EQ(start_filter(state, start), Status::kOk);
    for (int frame = 0; frame < 100; ++frame) {
      const Vec3 before = body.truth.rates.omega_radps;
      body.move(0.2);
      most = std::max(most, (body.truth.rates.omega_radps - before).norm() / (0.2 * before.squaredNorm()));
      ASSERT_EQ(predict_filter(state, state.t_us + 200'000, {0.01, 0.1 * kRadPerDeg, 0.25}), Status::kOk);
      const PoseMeasurement measured = measure(body.truth, state.t_us, covariance_of(random, 0.0007, 0.0005), random);
      ASSERT_TRUE(update_filter(state, measured, kNoGate).accepted);
      if (frame < 20) continue;
      const Vec12 error = error_of(state, body.truth);
      nees += error.dot(test::solution_of(state.covariance, error));
      ++count;
    }
  }
  EXPECT_GT(most, 0.2);
  EXPECT_LT(most, 0.5) << "what the header says of free bodies";
  EXPECT_LT(nees / count, 1.1 * 12);
}

}  // namespace
}  // namespace lasso::test
