#include "ft/bodies/likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::bodies {
namespace {

using N = FlightNumber;

class LikelihoodTest : public test::PoseFixture {
 protected:
  LikelihoodTest() {
    parameters().surface_sigma_m = 0;
    parameters().incidence_max_rad = 1.5707;
    parameters().dropout_probability = 0.05;
    parameters().agreement_min = 0.98;
    scan_.sigma_m = 1e-3;
  }

  double likelihood(const Pose& T_sensor_target, const Mat6& covariance = Mat6::Zero()) const {
    Registration found;
    found.T_sensor_target = T_sensor_target;
    found.covariance = covariance;
    return log_likelihood(mission_, found, true, *workspace_);
  }

  // Without any doubt, by the box's closed form.
  double expected(const Pose& T_sensor_target) const {
    const Pose T_target_sensor = inverse(T_sensor_target);
    double sum = 0;
    for (const ScanRay<N>& ray : workspace_->rays) {
      Vec3 o, u;
      for (int i = 0; i < 3; ++i) {
        o[i] = N::to_double(ray.o[i]);
        u[i] = N::to_double(ray.u[i]);
      }
      const double range_m = test::cast_box(scan_.model, T_target_sensor * o, rotate(T_target_sensor.q, u));
      if (ray.state != RayState::kHit) {
        sum += std::log(range_m > 0 ? 0.02 + 0.98 * 0.05 : 1);
        continue;
      }
      const double off = (N::to_double(ray.range) - range_m) / 1e-3;
      const double density = range_m > 0 ? 0.95 * std::exp(-0.5 * off * off) / (std::sqrt(2 * kPi) * 1e-3) : 0;
      sum += std::log(0.98 * density + 0.02 / (parameters_of().range_max_m - parameters_of().range_min_m));
    }
    return sum;
  }
  const MissionParameters& parameters_of() const { return mission_.parameters; }
};

// The grid of the box's field is exact but for rounding, so that a ray within it of an edge may differ from the closed form.
TEST_F(LikelihoodTest, IsTheSumOverReturnsAndMisses) {
  VERIFIES("LASSO-GND-160~1");
  int equal = 0;
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const Pose pose = test::disturb(scan_.T_sensor_target, 0.01, 0.002, random_);
    const double difference = std::abs(likelihood(pose) - expected(pose));
    EXPECT_LT(difference, 40);  // three such rays
    equal += difference < 0.2 ? 1 : 0;
  }
  EXPECT_GE(equal, 16);
}

TEST_F(LikelihoodTest, OfTheTruthIsHigherThanOfOtherPoses) {
  VERIFIES("LASSO-GND-160~1");
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const Pose other = test::disturb(scan_.T_sensor_target, 0.1, 0.02, random_);
    EXPECT_GT(likelihood(scan_.T_sensor_target), likelihood(other) + 50);
  }
}

TEST_F(LikelihoodTest, WhatThePoseLeavesOpenIsForgiven) {
  VERIFIES("LASSO-GND-160~1");
  scan();
  Pose off = scan_.T_sensor_target;
  off.p.x() += 0.006;
  Mat6 covariance = 1e-10 * Mat6::Identity();
  covariance(3, 3) = 0.003 * 0.003;
  EXPECT_GT(likelihood(off, covariance), likelihood(off) + 50);
}

}  // namespace
}  // namespace lasso::bodies
