#pragma once

#include <cmath>
#include <memory>

#include "fsw/pose/tracking/bearing.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

constexpr TimeUs kPeriodUs = 200000;

// Full-field scans of a box, each with its own noise.
class BearingTest : public ::testing::Test {
 protected:
  BearingTest() {
    mission_.parameters = preset_parameters();
    mission_.parameters.sigma0_m = 0.02;
    mission_.parameters.sigma_k_per_m = 0;
    mission_.parameters.range_min_m = 1;
    mission_.parameters.range_max_m = 100;
    place(20, 1);
    scene_.rates = Twist{};
  }

  // A box of a tenth of the range, in a general attitude.
  void place(double range_m, std::uint64_t seed) {
    Generator random(seed);
    scene_.box.half = 0.08 * range_m * Vec3(1.3, 0.5, 0.8);
    scene_.box.center = 0.1 * range_m * Vec3(0.1, 0.05, -0.1);
    Vec3 turn;
    for (int i = 0; i < 3; ++i) turn[i] = random.normal();
    scene_.at_zero.q = exp_so3(turn);
    scene_.at_zero.p = Vec3(0, 0, range_m);
    for (int i = 0; i < 2; ++i) scene_.at_zero.p[i] = range_m * random.uniform(-0.08, 0.08);
    scene_.sigma_m = 0.02;
    mission_.radius_m = scene_.box.half.norm() + scene_.box.center.norm();
  }

  // A full-field rosette at k periods.
  RangeImage& scan(std::uint32_t k) {
    ScanPlan plan;
    plan.scan_id = k;
    plan.phase_turns = std::fmod(0.382 * k, 1);
    plan.half_x = plan.half_y = std::tan(mission_.parameters.fov_half_x_rad);
    Generator random(seed_ + k);
    scan_->scan_id = k;
    scan_->samples.clear();
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      EXPECT_TRUE(scan_->samples.push_back(cast_sample(scene_, plan, i, k * kPeriodUs + pattern_time_us(plan, i), random)));
    }
    return *scan_;
  }
  Bearing find(std::uint32_t k) { return finder_->find(mission_, scan(k), state_); }
  Bearing find(const RangeImage& image) { return finder_->find(mission_, image, state_); }

  // Turns rays that missed into returns.
  void add_strays(double share, RangeImage& image) {
    for (RangeSample& sample : image.samples) {
      if (strays_.uniform(0, 1) >= share) continue;
      sample.state = RayState::kHit;
      sample.range_m = static_cast<float>(strays_.uniform(1, 1.5 * scene_.at_zero.p.z()));
    }
  }
  static void add_wall(double z_m, RangeImage& image) {
    for (RangeSample& sample : image.samples) {
      if (sample.state == RayState::kHit) continue;
      sample.state = RayState::kHit;
      sample.range_m = static_cast<float>(z_m) / sample.direction[2];
    }
  }
  // The centroid that a scan of this target alone must give, from the samples themselves.
  static Vec3 mean_of(const RangeImage& image) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const RangeSample& sample : image.samples) {
      if (sample.state != RayState::kHit) continue;
      sum += static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
      ++count;
    }
    return sum / count;
  }
  void expect_refused(BearingReason reason, const RangeImage& image) {
    const BearingState before = state_;
    const Bearing bearing = find(image);
    EXPECT_EQ(bearing.reason, reason) << to_string(bearing.reason);
    EXPECT_TRUE(bearing.value.isZero(0)) << "nothing stale";
    EXPECT_TRUE(bearing.covariance.isZero(0));
    EXPECT_EQ(bearing.scans, 0u);
    EXPECT_EQ(state_.started, before.started);
    EXPECT_EQ(state_.t_us, before.t_us);
    EXPECT_EQ(state_.p_m, before.p_m);
    EXPECT_EQ(state_.scans, before.scans);
  }

  BoxScene scene_;
  Mission mission_;
  BearingState state_;
  std::uint64_t seed_ = 100;
  Generator strays_{3};
  std::unique_ptr<BearingFinder> finder_ = std::make_unique<BearingFinder>();
  std::unique_ptr<RangeImage> scan_ = std::make_unique<RangeImage>();
};

}  // namespace lasso::test
