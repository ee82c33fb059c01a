#pragma once

#include <memory>

#include "fsw/mode/tracker.hpp"
#include "fsw/sense/planner.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

constexpr TimeUs kPeriodUs = 200000;

// A box that is tracked by scans with noise.
class TrackerTest : public ::testing::Test {
 protected:
  void SetUp() override { load(box_parameters(scene_)); }

  void load(const MissionParameters& parameters) {
    image_ = make_box_image(parameters, scene_.box);
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
  }

  // Starts at t = 0 with an error of `off` (rotation, translation).
  void start(const Vec6& off) {
    Pose pose = scene_.at_zero;
    pose.q = normalized(exp_so3(off.head<3>()) * pose.q);
    pose.p += off.tail<3>();
    ASSERT_EQ(start_at(pose, Twist{}, 0, 0), StartRefusal::kNone);
  }

  StartRefusal start_at(const Pose& pose, const Twist& rates, TimeUs stated_us, TimeUs t_us) {
    return start_track(mission_, InitialPoseSource::kUplink, rough_offer(mission_.parameters, pose, rates, stated_us), t_us, state_);
  }

  RangeImage& scan(std::uint32_t scan_id) {
    const TimeUs start_us = scan_id * kPeriodUs;
    ScanPlan plan;
    EXPECT_EQ(plan_scan(mission_.parameters, {mission_.hull, mission_.center_m}, scene_.pose_at(start_us), scan_id, plan), Status::kOk);
    Generator random(scan_id + 1u);
    image_of_scan_->scan_id = scan_id;
    image_of_scan_->samples.clear();
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      const TimeUs t_us = start_us + pattern_time_us(plan, i);
      EXPECT_TRUE(image_of_scan_->samples.push_back(cast_sample(scene_, plan, i, t_us, random)));
      if (spoiled_ && i % 25 == 0) image_of_scan_->samples[i].range_m += 0.4f;
    }
    return *image_of_scan_;
  }

  TrackStep track(std::uint32_t scan_id) {
    const TrackStep step = track_scan(mission_, *estimator_, scan(scan_id), state_);
    state_ = step.after;
    return step;
  }

  TrackStep miss(std::uint32_t scan_id) {
    const TrackStep step = track_without_scan(mission_, PoseReason::kNoScan, scan_id, scan_id * kPeriodUs + 90000, state_);
    state_ = step.after;
    return step;
  }

  Vec6 error(const Pose& estimate, TimeUs t_us) const { return pose_difference(estimate, scene_.pose_at(t_us)); }

  BoxScene scene_ = default_scene();
  TestImage image_;
  Mission mission_;
  TrackState state_;
  bool spoiled_ = false;  // one return of 25 is wrong
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> image_of_scan_ = std::make_unique<RangeImage>();
};

inline Vec6 small_error() {
  Vec6 off;
  off << 0.03, -0.02, 0.025, 0.01, -0.015, 0.02;
  return off;
}

}  // namespace lasso::test
