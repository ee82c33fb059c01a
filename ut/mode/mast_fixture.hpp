#pragma once

#include "ut/mode/tracker_fixture.hpp"
#include "ut/support/box_tables.hpp"

namespace lasso::test {

// Two boxes, which no turn makes look alike; half a turn brings the larger one on itself.
class MastTest : public TrackerTest {
 protected:
  MastTest() {
    others_[0].center = Vec3(0.24, 0.15, -0.32);
    others_[0].half = Vec3(0.05, 0.04, 0.20);
  }

  void load_with_others(double share_min) {
    MissionParameters p = box_parameters(scene_);
    p.start_frames = 4;
    p.start_inlier_share_min = share_min;
    Boxes boxes{scene_.box};
    boxes.insert(boxes.end(), others_.begin(), others_.end());
    image_ = make_image(p, make_box_tables(boxes));
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
  }

  TrackStep track_view(std::uint32_t k) {
    BoxScan view{scene_.box, {}, scene_.at_zero, {}, 1e-3};
    view.others = others_;
    view.half_angle = 0.25;
    seen_ = scan_box(view, random_);
    for (RangeSample& sample : seen_->samples) sample.t_us += k * kPeriodUs;
    const TrackStep step = track_scan(mission_, *estimator_, *seen_, state_);
    state_ = step.after;
    return step;
  }

  void start_turned(const Vec3& axis) {
    state_ = TrackState{};
    Vec6 off = Vec6::Zero();
    off.head<3>() = kPi * axis;
    start(off);
  }

  Boxes others_{BoxModel()};  // beside the scene's box
  Generator random_{5};
  std::unique_ptr<RangeImage> seen_;  // the last scan
};

}  // namespace lasso::test
