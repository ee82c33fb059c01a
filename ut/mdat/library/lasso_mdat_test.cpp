#include "mdat/library/lasso_mdat.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <memory>

#include "fsw/mode/searcher.hpp"
#include "hal_sim/raw_scan.hpp"
#include "mdat/replay/single_scans.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::BoxScan;

// A target without symmetry, a scan of it, and a start that is a little off.
class LibraryTest : public ::testing::Test {
 protected:
  LibraryTest() {
    scan_.T_sensor_target = test::generic_box_pose();
    scan_.others = {test::uneven_boxes()[1], test::uneven_boxes()[2]};
    scan_.sigma_m = 1e-3;
    scan_.half_angle = 0.3;
    test::Generator random(7);
    samples_ = test::scan_box(scan_, random);
    prior_ = test::disturb(scan_.T_sensor_target, 0.02, 0.01, random);
    for (const RangeSample& sample : samples_->samples) {
      lasso_ray ray{};
      std::copy(std::begin(sample.direction), std::end(sample.direction), std::begin(ray.direction));
      ray.range_m = sample.range_m;
      ray.t_us = sample.t_us;
      ray.sigma_factor = sample.sigma_factor;
      ray.state = static_cast<std::int32_t>(sample.state);
      rays_.push_back(ray);
    }
    target_ = lasso_open(image().data(), image().size, why_.data(), why_.size());
    EXPECT_NE(target_, nullptr) << why_.data();
  }
  ~LibraryTest() override { lasso_close(target_); }

  // Loading changes the bytes in place: each test has its own.
  static test::TestImage image() {
    static const test::TestImage made =
        test::make_image(test::box_parameters(test::uneven_scene()), test::make_box_tables(test::uneven_boxes()));
    return made;
  }
  std::array<double, 7> prior() const {
    return {prior_.q.x(), prior_.q.y(), prior_.q.z(), prior_.q.w(), prior_.p.x(), prior_.p.y(), prior_.p.z()};
  }
  int register_scan(const std::array<double, 7>& from, lasso_registration& result) {
    const lasso_scan scan{rays_.data(), rays_.size(), 1};
    return lasso_register(target_, &scan, from.data(), 0, &result, why_.data(), why_.size());
  }
  std::string why() const { return why_.data(); }

  BoxScan scan_;
  std::unique_ptr<RangeImage> samples_;
  Pose prior_;
  std::vector<lasso_ray> rays_;
  std::array<char, 200> why_{};
  lasso_target* target_ = nullptr;
};

// To the last bit: nothing is rounded on the way through the interface.
void expect_same(const Pose& pose, const double (&values)[7]) {
  const double all[] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w(), pose.p.x(), pose.p.y(), pose.p.z()};
  EXPECT_EQ(std::memcmp(all, values, sizeof all), 0);
}

TEST_F(LibraryTest, RegistersAsAReplayDoes) {
  VERIFIES("LASSO-GND-142~1");
  lasso_registration result{};
  ASSERT_EQ(register_scan(prior(), result), 0) << why();
  test::TestImage copy = image();
  Mission mission;
  ASSERT_EQ(load_image(Bytes(copy.data(), copy.size), mission).status, Status::kOk);
  const Registration expected = SingleScans(mission).estimate(*samples_, {{normalized(prior_.q), prior_.p}, {}, false});
  EXPECT_EQ(result.valid, 1) << lasso_reason(result.reason);
  expect_same(expected.T_sensor_target, result.pose);
  EXPECT_EQ(result.t_us, expected.t_us);
  EXPECT_EQ(result.inliers, expected.inliers);
  EXPECT_EQ(result.rms_m, expected.rms_m);
  for (int i = 0; i < 36; ++i) EXPECT_EQ(result.covariance[i], expected.covariance(i / 6, i % 6));
  const Pose found{Quat(result.pose[3], result.pose[0], result.pose[1], result.pose[2]),
                   Vec3(result.pose[4], result.pose[5], result.pose[6])};
  EXPECT_LT(pose_difference(found, scan_.T_sensor_target).tail<3>().norm(), 1e-3) << "and it is the true pose";
}

TEST_F(LibraryTest, SearchesAsAReplayDoes) {
  VERIFIES("LASSO-GND-142~1");
  lasso_search_result result{};
  const lasso_scan scan{rays_.data(), rays_.size(), 1};
  ASSERT_EQ(lasso_search(target_, &scan, &result, why_.data(), why_.size()), 0) << why();
  ASSERT_GE(result.candidates, 1) << lasso_search_reason(result.reason);
  EXPECT_EQ(std::memcmp(result.pose, result.candidate[0].pose, sizeof result.pose), 0);
  const Pose found{Quat(result.pose[3], result.pose[0], result.pose[1], result.pose[2]),
                   Vec3(result.pose[4], result.pose[5], result.pose[6])};
  const Vec6 off = pose_difference(found, scan_.T_sensor_target);
  EXPECT_LT(off.tail<3>().norm(), 5e-3) << lasso_outcome(result.outcome);
  EXPECT_LT(off.head<3>().norm(), 0.02) << lasso_outcome(result.outcome);
}

TEST_F(LibraryTest, PointsBecomeTheRaysThatAFileOfThemGives) {
  VERIFIES("LASSO-GND-142~1");
  sim::RawScan raw;
  raw.misses_known = true;
  std::vector<double> points, times;
  std::vector<std::uint8_t> hits;
  for (const lasso_ray& ray : rays_) {
    const bool hit = ray.state == 0;
    const double length = hit ? static_cast<double>(ray.range_m) : 1;
    Vec3 place;
    for (int i = 0; i < 3; ++i) place[i] = static_cast<double>(ray.direction[i]) * length;
    for (int i = 0; i < 3; ++i) points.push_back(place[i]);
    times.push_back(1e-6 * static_cast<double>(ray.t_us));
    hits.push_back(hit ? 1 : 0);
    hit ? raw.add_point(place, times.back(), 1) : raw.add_miss(place / place.stableNorm(), times.back(), 1);
  }
  const auto expected = std::make_unique<RangeImage>(sim::to_image(raw, sim::ScanFrame{}));
  std::vector<lasso_ray> rays(lasso_most_rays());
  std::size_t count = 0;
  ASSERT_EQ(lasso_rays_of_points(points.data(), times.data(), hits.data(), hits.size(), rays.data(), &count, why_.data(), why_.size()), 0);
  ASSERT_EQ(count, expected->samples.size());
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(std::memcmp(rays[i].direction, expected->samples[i].direction, sizeof rays[i].direction), 0);
    EXPECT_EQ(rays[i].range_m, expected->samples[i].range_m);
    EXPECT_EQ(rays[i].t_us, expected->samples[i].t_us);
    EXPECT_EQ(rays[i].state, static_cast<std::int32_t>(expected->samples[i].state));
  }
}

TEST_F(LibraryTest, RefusesBadInputInWords) {
  VERIFIES("LASSO-GND-142~1");
  const std::uint8_t no_image[] = {1, 2, 3, 4};
  EXPECT_EQ(lasso_open(no_image, sizeof no_image, why_.data(), why_.size()), nullptr);
  EXPECT_NE(why().find("not a valid flight image"), std::string::npos) << why();
  lasso_registration result{};
  std::array<double, 7> long_one = prior();
  long_one[3] += 0.1;
  EXPECT_EQ(register_scan(long_one, result), LASSO_BAD_INPUT);
  EXPECT_NE(why().find("quaternion"), std::string::npos) << why();
  rays_[5].t_us = 0;
  EXPECT_EQ(register_scan(prior(), result), LASSO_BAD_INPUT);
  EXPECT_EQ(why(), "ray 5: is earlier than the one before");
  rays_.resize(lasso_most_rays() + 1, rays_[0]);
  EXPECT_EQ(register_scan(prior(), result), LASSO_BAD_INPUT);
  EXPECT_NE(why().find("expected at most"), std::string::npos) << why();
  rays_.clear();
  EXPECT_EQ(register_scan(prior(), result), LASSO_BAD_INPUT);
  EXPECT_EQ(why(), "the scan has no ray");
}

TEST_F(LibraryTest, WordsFitTheRoomThatIsGiven) {
  VERIFIES("LASSO-GND-142~1");
  std::array<char, 6> little{};
  lasso_registration result{};
  EXPECT_EQ(lasso_register(target_, nullptr, prior().data(), 0, &result, little.data(), little.size()), LASSO_BAD_INPUT);
  EXPECT_STREQ(little.data(), "the s");
  EXPECT_EQ(lasso_register(target_, nullptr, prior().data(), 0, &result, nullptr, 0), LASSO_BAD_INPUT);
}

}  // namespace
}  // namespace lasso::mdat
