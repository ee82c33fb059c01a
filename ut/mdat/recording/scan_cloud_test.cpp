#include "mdat/recording/scan_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "ut/mdat/recording/wall.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::vector<RangeSample> random_scan(std::uint64_t seed) {
  sim::Random random(seed);
  std::vector<RangeSample> samples;
  for (int i = 0; i < 50; ++i) {
    const double x = random.uniform(-0.2, 0.2), y = random.uniform(-0.2, 0.2);
    const Vec3 direction = Vec3(x, y, 1).normalized();
    RangeSample sample;
    for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(direction[k]);
    sample.state = static_cast<RayState>(random.bits() % 4);
    sample.range_m = sample.state == RayState::kHit ? static_cast<float>(random.uniform(1, 9)) : 0;
    sample.sigma_factor = static_cast<float>(random.uniform(1, 3));
    sample.t_us = 5'000'000 + 100 * i;
    samples.push_back(sample);
  }
  return samples;
}

bool same_bits(const RangeSample& a, const RangeSample& b) {
  return std::memcmp(a.direction, b.direction, sizeof a.direction) == 0 && std::memcmp(&a.range_m, &b.range_m, sizeof a.range_m) == 0 &&
         std::memcmp(&a.sigma_factor, &b.sigma_factor, sizeof a.sigma_factor) == 0 && a.t_us == b.t_us && a.state == b.state;
}

TEST(ScanCloud, HoldsEachSampleBitByBit) {
  VERIFIES("LASSO-REC-005~1");
  const std::vector<RangeSample> samples = random_scan(8);
  const ScanView view{samples, 5'002'500, {Quat::Identity(), Vec3(0, 0, 4)}, Twist{}};
  std::vector<RangeSample> back;
  ASSERT_TRUE(samples_of(scan_cloud(view, test::Wall()), view.t_us, back));
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_TRUE(same_bits(samples[i], back[i])) << i;
}

// A wall that turns and comes nearer, in closed form: n(t) . (range u - p(t)) = 0.
TEST(ScanCloud, ResidualsAreOfTheTargetAtEachRaysOwnTime) {
  VERIFIES("LASSO-REC-001~1");
  const std::vector<RangeSample> samples = random_scan(9);
  const Twist rates{Vec3(0.1, -0.2, 0.05), Vec3(0.02, 0.01, -0.3)};
  const ScanView view{samples, 5'000'000, {exp_so3(Vec3(0.2, 0.1, -0.4)), Vec3(0.1, -0.1, 4)}, rates};
  const ros::PointCloud cloud = scan_cloud(view, test::Wall());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    float residual_m = 0;
    std::memcpy(&residual_m, cloud.data.data() + i * cloud.step + 32, sizeof residual_m);
    EXPECT_EQ(std::isnan(residual_m), samples[i].state != RayState::kHit);
    if (samples[i].state != RayState::kHit) continue;
    const double t_s = 1e-4 * static_cast<double>(i);
    const Vec3 n = exp_so3(t_s * rates.omega_radps) * (view.T_sensor_target.q * Vec3::UnitZ());
    const Vec3 u = Eigen::Vector3f(samples[i].direction).cast<double>().normalized();
    const double range_m = n.dot(view.T_sensor_target.p + t_s * rates.v_mps) / n.dot(u);
    EXPECT_NEAR(residual_m, static_cast<double>(samples[i].range_m) - range_m, 1e-5) << i;
  }
}

TEST(ScanCloud, TellsEachRangesNoiseAndThePart) {
  VERIFIES("LASSO-REC-026~1");
  const std::vector<RangeSample> samples = random_scan(11);
  ScanView view{samples, 5'000'000, {Quat::Identity(), Vec3(0, 0, 4)}, Twist{}};
  view.part = 3;
  view.sigma0_m = 0.003;
  view.sigma_k_per_m = 0.001;
  const ros::PointCloud cloud = scan_cloud(view, test::Wall());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    float sigma_m = 0;
    std::memcpy(&sigma_m, cloud.data.data() + i * cloud.step + 44, sizeof sigma_m);
    const double range_m = static_cast<double>(samples[i].range_m), far_m = 0.001 * range_m * range_m;
    const double expected_m = static_cast<double>(samples[i].sigma_factor) * std::sqrt(9e-6 + far_m * far_m);
    EXPECT_EQ(std::isnan(sigma_m), samples[i].state != RayState::kHit);
    EXPECT_TRUE(samples[i].state != RayState::kHit || std::abs(static_cast<double>(sigma_m) - expected_m) < 1e-6) << i;
    EXPECT_EQ(cloud.data[i * cloud.step + 41], 3);
  }
}

TEST(ScanCloud, MissedRaysPassAtTheTargetsRange) {
  VERIFIES("LASSO-REC-001~1");
  const std::vector<RangeSample> samples = random_scan(10);
  const ScanView view{samples, 5'000'000, {Quat::Identity(), Vec3(0, 3, 4)}, Twist{}};
  const ros::PointCloud cloud = missed_cloud(view);
  std::size_t misses = 0;
  for (const RangeSample& sample : samples) misses += sample.state == RayState::kMiss ? 1 : 0;
  ASSERT_EQ(cloud.data.size(), misses * cloud.step);
  for (std::size_t i = 0; i < misses; ++i) {
    float point[3];
    std::memcpy(point, cloud.data.data() + i * cloud.step, sizeof point);
    EXPECT_NEAR(Eigen::Vector3f(point).cast<double>().norm(), 5, 1e-5);
  }
}

TEST(ScanCloud, AnotherCloudIsNotTakenForOne) {
  VERIFIES("LASSO-REC-008~2");
  std::vector<RangeSample> samples;
  EXPECT_FALSE(samples_of({{}, 16, std::string(32, '\0')}, 0, samples));
  EXPECT_FALSE(samples_of({{}, 44, std::string(50, '\0')}, 0, samples));
  EXPECT_FALSE(samples_of({{}, 44, std::string(44, '\x09')}, 0, samples));  // no such state
}

}  // namespace
}  // namespace lasso::mdat
