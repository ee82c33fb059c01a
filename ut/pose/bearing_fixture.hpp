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

  // The tenth of ten scans of a target that comes nearer by up to 2 % of its range in a second, and moves aside by a fifth of that.
  Bearing ten_scans(double range_m, std::uint64_t seed) {
    place(range_m, seed);
    Generator random(seed + 1000);
    const double speed = random.uniform(0, 0.02) * range_m;
    scene_.rates.v_mps = Vec3(0, 0, -speed);
    for (int i = 0; i < 2; ++i) scene_.rates.v_mps[i] = 0.2 * speed * random.normal();
    state_ = BearingState{};
    seed_ = 1000 * seed;
    Bearing bearing;
    for (std::uint32_t k = 0; k < 10; ++k) bearing = find(k);
    return bearing;
  }

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
  // The centroid that a scan of this target alone must give, from the samples themselves, and the mean of their times, us.
  static Vec3 mean_of(const RangeImage& image) {
    return mean_of(image, [](const RangeSample& sample) {
      return Vec3(static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>());
    });
  }
  // Of a return's depth, by the spread of the returns along the line of sight and the noise of each.
  double variance_of_depth(const RangeImage& image, const Vec3& mean) const {
    const Vec3 squares = mean_of(image, [&](const RangeSample& sample) {
      const Vec3 p = static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
      const double off_m = (p - mean).dot(mean) / mean.norm();
      return Vec3(off_m * off_m, 0, 0);
    });
    return squares.x() + scene_.sigma_m * scene_.sigma_m;
  }
  static double mean_time_of(const RangeImage& image) {
    return mean_of(image, [](const RangeSample& sample) { return Vec3(static_cast<double>(sample.t_us), 0, 0); }).x();
  }
  // The centroid of what the sensor sees of the target at a time: that of many scans without noise.
  Vec3 place_at(TimeUs t_us) const {
    BoxScene still = scene_;
    still.sigma_m = 0;
    const auto image = std::make_unique<RangeImage>();
    ScanPlan plan;
    plan.half_x = plan.half_y = std::tan(mission_.parameters.fov_half_x_rad);
    Generator unused(0);
    constexpr int kScans = 32;
    Vec3 sum = Vec3::Zero();
    for (int scan = 0; scan < kScans; ++scan) {
      plan.phase_turns = std::fmod(0.618 * scan + 0.05, 1);
      image->samples.clear();
      for (std::uint16_t i = 0; i < plan.points; ++i) EXPECT_TRUE(image->samples.push_back(cast_sample(still, plan, i, t_us, unused)));
      sum += mean_of(*image);
    }
    return sum / kScans;
  }
  // Azimuth, elevation, range of that, and what the target's velocity changes of them in a second.
  Vec6 truth_at(TimeUs t_us) const {
    const Vec3 place = place_at(t_us);
    const auto seen_after = [&](double s) {
      const Vec3 p = place + s * scene_.rates.v_mps;
      return Vec3(std::atan2(p.x(), p.z()), std::asin(-p.y() / p.norm()), p.norm());
    };
    Vec6 truth;
    truth << seen_after(0), (seen_after(1e-3) - seen_after(-1e-3)) / 2e-3;
    return truth;
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

  // Of the returns.
  template <class Value>
  static Vec3 mean_of(const RangeImage& image, Value value) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const RangeSample& sample : image.samples) {
      if (sample.state != RayState::kHit) continue;
      sum += value(sample);
      ++count;
    }
    return sum / count;
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
