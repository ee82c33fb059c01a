#include "fsw/pose/scan/prepare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

// Roundings of sigma on the way to what a point has: those of the noise's growth, times range and the sample's own factor.
constexpr double kSigmaRoundings = 16;

double variance_rounding(double variance) {
  const double sigma = std::sqrt(variance);
  return 2 * sigma * kSigmaRoundings * test::rounding_of<N::Sigma>(sigma) + test::rounding_of<N::Variance>(variance);
}

class PrepareTest : public test::PoseFixture {
 protected:
  PrepareTest() {
    scan_.side = 16;
    scan_.rates.omega_radps = Vec3(0.3, -0.5, 0.4);
    scan_.rates.v_mps = Vec3(0.3, -0.2, 0.5);
  }
  // T_target_sensor when the sample was taken, relative to the scan's reference time.
  Pose pose_at(const RangeSample& sample) const {
    const double tau_s = to_seconds(sample.t_us - image_->reference_time_us());
    return inverse(propagate(scan_.T_sensor_target, scan_.rates, tau_s));
  }
};

TEST_F(PrepareTest, MovesEachRayByTheMotionSinceItsOwnTime) {
  VERIFIES("LASSO-REG-004~2");
  scan();
  ASSERT_EQ(workspace_->rays.size(), image_->samples.size());
  double farthest = 0;
  for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
    const ScanRay<N>& ray = workspace_->rays[i];
    const RangeSample& sample = image_->samples[i];
    const Pose then = pose_at(sample);
    const double cayley = std::pow(log_so3(truth().q.conjugate() * then.q).norm(), 3) / 12;  // stated in prepare.cpp
    EXPECT_LT((truth() * to_vec3(ray.o) - then.p).norm(), 2e-6 + 3 * cayley);
    EXPECT_LT((rotate(truth().q, to_vec3(ray.u)) - rotate(then.q, to_vec3(sample.direction))).norm(), 3e-7 + cayley);
    farthest = std::max(farthest, to_vec3(ray.o).norm());
  }
  EXPECT_GT(farthest, 0.1);  // it is no small matter here
}

TEST_F(PrepareTest, PointsLieOnTheBoxAtTheReferenceTime) {
  VERIFIES("LASSO-REG-004~2");
  scan_.rates.omega_radps = Vec3(0.1, -0.15, 0.12);
  scan();
  ASSERT_GT(workspace_->points.size(), 60u);
  for (const MatchPoint<N>& point : workspace_->points) {
    const Vec3 away = truth() * to_vec3(point.p) - scan_.model.center;
    const double depth = (away.cwiseAbs() - scan_.model.half).maxCoeff();  // 0 on the surface
    EXPECT_NEAR(depth, 0, 3e-6);
    EXPECT_EQ(point.element, kNoElement);
  }
}

TEST_F(PrepareTest, RaysStayAsMeasuredWithoutMotionOrDeskewing) {
  VERIFIES("LASSO-REG-004~2");
  for (const bool deskew : {false, true}) {
    parameters().deskew = deskew ? 1 : 0;
    if (deskew) scan_.rates = Twist{};
    scan();
    for (std::size_t i = 0; i < workspace_->rays.size(); ++i) {
      EXPECT_EQ(to_vec3(workspace_->rays[i].o), Vec3(Vec3::Zero()));
      for (int k = 0; k < 3; ++k) EXPECT_EQ(workspace_->rays[i].u[k], N::from_float<N::Unit>(image_->samples[i].direction[k]));
    }
  }
}

TEST_F(PrepareTest, ANoiseModelThatGrowsWithRange) {
  VERIFIES("LASSO-REG-003~2");
  parameters().sigma_k_per_m = 1.3e-4;
  parameters().sigma_angle_rad = 4e-4;
  parameters().surface_sigma_m = 2e-4;
  RangeImage image;
  for (const float range : {0.7F, 2.0F, 9.0F}) {
    RangeSample sample;
    sample.range_m = range;
    sample.state = RayState::kHit;
    ASSERT_TRUE(image.samples.push_back(sample));
  }
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  for (const MatchPoint<N>& point : workspace_->points) {
    const double z = to_vec3(point.p).norm();
    const double along2 = 1e-3 * 1e-3 + std::pow(1.3e-4 * z * z, 2);
    const double across2 = std::pow(4e-4 * z, 2);
    EXPECT_NEAR(static_cast<double>(point.range_variance), along2, variance_rounding(along2));
    EXPECT_NEAR(static_cast<double>(point.across_variance), across2, variance_rounding(across2));
    // The surface may lie k sigma off along the ray, sigma as it is at up to 76 deg of incidence.
    const double reach = static_cast<double>(point.reach);
    EXPECT_GE(reach, parameters().kernel_width * std::sqrt(along2 + 16 * across2 + 2e-4 * 2e-4));
    EXPECT_LE(reach, parameters().kernel_width * 2 * std::sqrt(along2 + 16 * across2 + 2e-4 * 2e-4));  // four terms, not their root
  }
}

// What the sensor says of itself is not what it says of a range that it trusts less.
TEST_F(PrepareTest, ASampleOfLargerSigmaWeighsLess) {
  VERIFIES("LASSO-LCS-008~2");
  parameters().sigma_k_per_m = 1.3e-4;
  parameters().sigma_angle_rad = 4e-4;
  RangeImage image;
  for (const float factor : {1.0F, 5.0F}) {
    RangeSample sample;
    sample.range_m = 4;
    sample.state = RayState::kHit;
    sample.sigma_factor = factor;
    ASSERT_TRUE(image.samples.push_back(sample));
  }
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  const auto& points = workspace_->points;
  const double sigma_m = 1e-3 + 1.3e-4 * 16;
  const double variance = 1e-6 + std::pow(1.3e-4 * 16, 2);
  EXPECT_NEAR(static_cast<double>(points[0].range_variance), variance, variance_rounding(variance));
  EXPECT_NEAR(static_cast<double>(points[1].range_variance), 25 * variance, variance_rounding(25 * variance));
  EXPECT_EQ(points[1].across_variance, points[0].across_variance);
  EXPECT_NEAR(static_cast<double>(points[1].reach - points[0].reach), parameters().kernel_width * 4 * sigma_m,
              parameters().kernel_width * kSigmaRoundings * test::rounding_of<N::Sigma>(5 * sigma_m));
}

TEST_F(PrepareTest, KeepsMissesAndLeavesInvalidSamplesOut) {
  VERIFIES("LASSO-REG-006~2 LASSO-REG-009~1 LASSO-REG-017~2");
  const RayState states[] = {RayState::kMiss, RayState::kInvalid, RayState::kHit, RayState::kInvalid, RayState::kMiss, RayState::kHit};
  RangeImage image;
  for (const RayState state : states) {
    RangeSample sample;
    sample.direction[0] = 0.1F * static_cast<float>(image.samples.size());
    sample.range_m = 2;  // also where it means nothing
    sample.state = state;
    ASSERT_TRUE(image.samples.push_back(sample));
  }
  image.aimed_first = 3;
  image.aimed_count = 2;
  scan();  // what it left behind is cleared
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  ASSERT_EQ(workspace_->rays.size(), 4u);
  ASSERT_EQ(workspace_->points.size(), 2u);
  const std::size_t kept[] = {0, 2, 4, 5};
  for (std::size_t i = 0; i < 4; ++i) {
    const ScanRay<N>& ray = workspace_->rays[i];
    EXPECT_EQ(ray.state, states[kept[i]]);
    EXPECT_EQ(ray.u[0], N::from_float<N::Unit>(0.1F * static_cast<float>(kept[i])));
    EXPECT_EQ(ray.range, ray.state == RayState::kHit ? N::Length{2} : N::Length{0});
  }
  EXPECT_FALSE(workspace_->points[0].aimed);
  EXPECT_FALSE(workspace_->points[1].aimed);
  image.aimed_count = 3;
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  EXPECT_FALSE(workspace_->points[0].aimed);
  EXPECT_TRUE(workspace_->points[1].aimed);
  EXPECT_EQ(workspace_->points[1].u[0], N::Unit{0.5});
  EXPECT_EQ(workspace_->points[1].p[2], N::Length{2});
  StartPoint of_part;
  of_part.partial = true;
  prepare_rays(mission_, image, of_part, *workspace_);
  EXPECT_TRUE(workspace_->points[0].aimed) << "returns of a part's scan count as aimed ones";
  EXPECT_TRUE(workspace_->points[1].aimed);
}

TEST_F(PrepareTest, ReturnsFromWhereTheSensorDoesNotMeasureSayNothing) {
  VERIFIES("LASSO-REG-006~2");
  parameters().range_min_m = 0.5;
  parameters().range_max_m = 20;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RangeImage image;
  for (const float range : {0.5F, 0.49F, -2.0F, 20.0F, 20.1F, kNan, kInfinity, -kInfinity, 0.0F}) {
    RangeSample sample;
    sample.range_m = range;
    sample.state = RayState::kHit;
    ASSERT_TRUE(image.samples.push_back(sample));
  }
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  ASSERT_EQ(workspace_->rays.size(), 2u);
  ASSERT_EQ(workspace_->points.size(), 2u);
  EXPECT_EQ(workspace_->rays[0].range, N::Length{0.5});
  EXPECT_EQ(workspace_->rays[1].range, N::Length{20});
}

TEST_F(PrepareTest, ReturnsFromFartherThanTheNumberTypeHoldsSayNothing) {
  VERIFIES("LASSO-REG-006~2");
  parameters().range_max_m = 100 * N::kFarthest_m;
  RangeImage image;
  for (const double share : {0.9, 1.1, 4.0, 50.0}) {
    RangeSample sample;
    sample.range_m = static_cast<float>(share * N::kFarthest_m);
    sample.state = RayState::kHit;
    ASSERT_TRUE(image.samples.push_back(sample));
  }
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  ASSERT_EQ(workspace_->points.size(), 1u);
  EXPECT_TRUE(test::is_path_number(workspace_->points[0].p[2], static_cast<double>(image.samples[0].range_m)));
}

TEST_F(PrepareTest, TakesAsManyRaysAsAScanCanHave) {
  VERIFIES("LASSO-REG-009~1 LASSO-SNS-032~1");
  RangeImage image;
  RangeSample sample;
  sample.range_m = 2;
  sample.state = RayState::kHit;
  while (image.samples.push_back(sample)) {
  }
  prepare_rays(mission_, image, StartPoint(), *workspace_);
  EXPECT_EQ(workspace_->rays.size(), kMaxRays);
  EXPECT_EQ(workspace_->points.size(), kMaxRays);
}

}  // namespace
}  // namespace lasso
