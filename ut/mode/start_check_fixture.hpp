#pragma once

#include "fsw/mode/searcher.hpp"
#include "ut/mode/mast_fixture.hpp"

namespace lasso::test {

// Frames of a start whose scan is searched for a better pose (start.check).
class StartCheckTest : public MastTest {
 protected:
  void SetUp() override {
    others_ = uneven_scene().others;
    load_with_others(0);
    mission_.parameters.start_check = 1;
    mission_.parameters.search_slice = 2e7;  // the whole search in one frame
  }

  // A frame as the estimation task has it; its state is not taken.
  TrackStep try_frame(std::uint32_t k, bool lost = false) {
    const TrackState before = state_;
    TrackStep step = lost ? miss(k) : track_view(k);
    if (step.after.check.stage == StartCheck::Stage::kSearching)
      searcher_->check(mission_, lost ? nullptr : seen_.get(), *workspace_, step);
    state_ = before;
    return step;
  }
  TrackStep frame(std::uint32_t k, bool lost = false) {
    const TrackStep step = try_frame(k, lost);
    state_ = step.after;
    return step;
  }

  // A start that is turned half about an axis of the target, and that a scan would confirm.
  Vec3 deceptive_axis() {
    MissionParameters& p = mission_.parameters;
    p.inlier_share_min = p.agreement_min = p.start_check = 0;
    p.noise_tolerance = 1000;
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = rotate(scene_.at_zero.q, Vec3::Unit(i));
      start_turned(axis);
      if (!track_view(0).registration.valid()) continue;
      mission_.parameters.start_check = 1;
      return axis;
    }
    ADD_FAILURE() << "no turned start is confirmed by itself";
    return Vec3::UnitX();
  }

  // Ten frames of a right start, whose search goes on: the filter is established, and scans that it excludes are implausible.
  void follow_unchecked() {
    mission_.parameters.search_slice = 1000;
    mission_.parameters.agreement_min = 0;  // one scan does not bring the pose all the way of a jump
    start(small_error());
    for (std::uint32_t k = 0; k < 10; ++k) ASSERT_EQ(frame(k).registration.reason, PoseReason::kUnchecked) << k;
  }

  // The frame in which the search of such a start's scan ends.
  TrackStep verdict_on_deceptive_start(bool lost = false) {
    start_turned(deceptive_axis());
    EXPECT_EQ(frame(1).registration.reason, PoseReason::kUnchecked);
    return frame(2, lost);
  }

  std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
  std::unique_ptr<Searcher> searcher_ = std::make_unique<Searcher>();
};

}  // namespace lasso::test
