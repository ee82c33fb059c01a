// The mode close by: from tracking into it and back, and what a scan of a part does to the track.
#include "ut/mode/tracker_fixture.hpp"
#include "ut/support/box_parts.hpp"

namespace lasso {
namespace {

using test::small_error;
using M = TrackingMode;
using E = ModeEvent;

class TrackerPartsTest : public test::TrackerTest {
 protected:
  void SetUp() override {
    MissionParameters p = test::box_parameters(scene_);
    p.short_range_enter_m = 3;
    p.short_range_leave_m = 4;
    p.coast_frames = 2;
    set(p);
  }
  // The whole's image is built once; the tests differ in parameters.
  void set(const MissionParameters& p) {
    static const test::BoxTables whole = test::make_box_tables(test::BoxModel{});
    static const test::BoxTables tables = test::with_parts(whole, test::two_halves(), test::box_parameters(test::default_scene()));
    image_ = test::make_image(p, tables);
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_, parts_).status, Status::kOk);
  }
  // Tracked as a whole up to scan 2, which is the first one in the new mode.
  void come_near() {
    start(small_error());
    track(0);
    ASSERT_EQ(track(1).event, E::kNear);
    ASSERT_EQ(state_.mode, M::kShortRange);
  }
  TrackStep see(std::uint32_t scan_id, PartNumber part) {
    const TrackStep step = track_part(mission_, parts_, part, *estimator_, scan(scan_id), state_);
    state_ = step.after;
    return step;
  }
  MissionParameters& parameters() { return mission_.parameters; }

  Parts parts_;
};

TEST_F(TrackerPartsTest, ATrackThatIsNearGoesOnByParts) {
  VERIFIES("LASSO-MOD-164~2 LASSO-MOD-171~3");
  come_near();
  for (std::uint32_t k = 2; k < 12; ++k) {
    const TrackStep step = see(k, static_cast<PartNumber>(1 + k % 2));
    ASSERT_TRUE(step.registration.valid()) << k << " " << to_string(step.registration.reason);
    EXPECT_EQ(step.parts.scanned, 1 + k % 2);
    EXPECT_EQ(step.event, E::kPoseValid);
    EXPECT_EQ(state_.mode, M::kShortRange);
  }
  const Vec6 e = error(state_.filter.T_sensor_target, state_.filter.t_us);
  EXPECT_LT(e.head<3>().norm(), 2e-3);
  EXPECT_LT(e.tail<3>().norm(), 1e-3);
  EXPECT_EQ(state_.filter.accepted, 11U);
}

TEST_F(TrackerPartsTest, LeavesAtALargerRangeThanItEnters) {
  VERIFIES("LASSO-MOD-164~2 LASSO-MOD-171~3");
  come_near();
  parameters().short_range_enter_m = 1;  // between the two nothing happens
  EXPECT_EQ(see(2, 1).after.mode, M::kShortRange);
  parameters().short_range_leave_m = 2;
  const TrackStep step = see(3, 2);
  EXPECT_EQ(step.event, E::kFar);
  EXPECT_EQ(step.after.mode, M::kTracking);
  EXPECT_EQ(see(4, 1).after.mode, M::kTracking) << "a scan of a part that was in flight serves";
  EXPECT_EQ(state_.filter.accepted, 4U) << "of the same filter since the start";
  EXPECT_TRUE(track(5).registration.valid());
}

TEST_F(TrackerPartsTest, AModeThatIsHeldIsNotLeftForTheRange) {
  VERIFIES("LASSO-MOD-136~4");
  start(small_error());
  track(0);
  state_.held = true;
  EXPECT_EQ(track(1).event, E::kPoseValid);
  EXPECT_EQ(state_.mode, M::kTracking);
  state_.held = false;
  EXPECT_EQ(track(2).event, E::kNear);
  state_.held = true;
  parameters().short_range_leave_m = 1;
  EXPECT_EQ(see(3, 1).event, E::kPoseValid);
}

// The target is 2.5 m away.
TEST_F(TrackerPartsTest, ShortRangeThatIsCommandedFarAwayStaysUntilTheTargetHasComeAndGone) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-171~3");
  parameters().short_range_enter_m = 1;
  parameters().short_range_leave_m = 2;
  start(small_error());
  track(0);
  EXPECT_EQ(track(1).event, E::kPoseValid);
  change_mode(E::kNear, state_);
  for (std::uint32_t k = 2; k < 4; ++k) EXPECT_EQ(see(k, 1).event, E::kPoseValid) << "beyond leave_m";
  miss(4);
  EXPECT_TRUE(state_.range_awaited);
  parameters().short_range_leave_m = 4;  // as if it had come
  EXPECT_EQ(see(5, 2).after.mode, M::kShortRange);
  EXPECT_FALSE(state_.range_awaited);
  parameters().short_range_leave_m = 2;  // and gone
  EXPECT_EQ(see(6, 1).event, E::kFar);
  EXPECT_EQ(state_.mode, M::kTracking);
}

TEST_F(TrackerPartsTest, TrackingThatIsCommandedCloseByStaysUntilTheTargetHasGoneAndCome) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-171~3");
  come_near();
  EXPECT_EQ(see(2, 1).event, E::kPoseValid);
  change_mode(E::kFar, state_);
  EXPECT_EQ(track(3).event, E::kPoseValid) << "within enter_m";
  miss(4);
  ASSERT_EQ(state_.mode, M::kCoasting);
  EXPECT_EQ(track(5).after.mode, M::kTracking);
  EXPECT_EQ(track(6).event, E::kPoseValid) << "a scan without a pose changes nothing of that";
  parameters().short_range_enter_m = 1;  // as if it had gone
  EXPECT_EQ(track(7).event, E::kPoseValid);
  parameters().short_range_enter_m = 3;  // and come
  EXPECT_EQ(track(8).event, E::kNear);
}

TEST_F(TrackerPartsTest, ATrackThatStartsAnewGoesByTheRange) {
  VERIFIES("LASSO-MOD-171~3");
  come_near();
  change_mode(E::kFar, state_);
  ASSERT_TRUE(state_.range_awaited);
  start(small_error());
  EXPECT_FALSE(state_.range_awaited);
}

// Whether it was the range or a command that led to the mode in which the target was lost.
TEST_F(TrackerPartsTest, ATrackThatIsReacquiredGoesByTheRange) {
  VERIFIES("LASSO-MOD-164~2 LASSO-MOD-171~3");
  for (const bool commanded : {false, true}) {
    come_near();
    if (commanded) change_mode(E::kFar, state_);
    ASSERT_TRUE(state_.range_awaited);
    change_mode(E::kReacquire, state_);
    ASSERT_EQ(track(2).after.mode, M::kTracking) << commanded;
    EXPECT_EQ(track(3).event, E::kNear) << commanded;
    EXPECT_EQ(state_.mode, M::kShortRange) << commanded;
  }
}

TEST_F(TrackerPartsTest, StartingAndCoastingAreNotCutShort) {
  VERIFIES("LASSO-MOD-171~3");
  start(small_error());
  EXPECT_EQ(track(0).event, E::kPoseValid);
  miss(1);
  ASSERT_EQ(state_.mode, M::kCoasting);
  EXPECT_EQ(track(2).after.mode, M::kTracking);
  EXPECT_EQ(track(3).after.mode, M::kShortRange);
}

TEST_F(TrackerPartsTest, PartsWithoutAPoseAreBridgedAndThenTheTrackIsLost) {
  VERIFIES("LASSO-MOD-005~2");
  come_near();
  for (std::uint32_t k = 2; k < 4; ++k) {
    miss(k);
    EXPECT_EQ(state_.mode, M::kShortRange);
    EXPECT_EQ(state_.missed, k - 1);
  }
  miss(4);
  EXPECT_EQ(state_.mode, M::kLost);
}

TEST_F(TrackerPartsTest, APartWithoutAPoseRests) {
  VERIFIES("LASSO-MOD-162~1");
  come_near();
  parts_[0].mission.parameters.inliers_min = 4000;
  const TrackStep step = see(2, 1);
  EXPECT_EQ(step.registration.reason, PoseReason::kTooFewReturns);
  EXPECT_EQ(step.event, E::kPoseInvalid);
  EXPECT_TRUE(rests(state_.parts.of[0], 3));
  EXPECT_EQ(state_.filter.accepted, 1U);
}

TEST_F(TrackerPartsTest, APartWhosePoseTheTrackRefusesRests) {
  VERIFIES("LASSO-MOD-162~1");
  come_near();
  for (std::uint32_t k = 2; k < 8; ++k) ASSERT_TRUE(see(k, 1).registration.valid());
  parts_[1].T_target_part.p += Vec3(0, 0.006, 0.004);
  state_.parts = PartsState{};  // nobody to compare with
  parameters().innovation_max = 2;
  const TrackStep step = see(8, 2);
  EXPECT_EQ(step.registration.reason, PoseReason::kImplausible);
  EXPECT_FALSE(state_.parts.of[1].measured);
  EXPECT_TRUE(rests(state_.parts.of[1], 9));
  EXPECT_FALSE(rests(state_.parts.of[0], 9));
}

// The model of the image has the right half where it is not.
TEST_F(TrackerPartsTest, APartThatMovedAgainstTheTargetIsDropped) {
  VERIFIES("LASSO-MOD-162~1");
  parts_[1].T_target_part.p += Vec3(0, 0.006, 0.004);
  parts_[1].priority = 0.5;
  come_near();
  EXPECT_TRUE(see(2, 1).registration.valid());
  EXPECT_TRUE(see(3, 1).registration.valid());
  const TrackStep step = see(4, 2);
  EXPECT_EQ(step.registration.reason, PoseReason::kPartDisagrees);
  EXPECT_EQ(step.parts.inconsistent, 2);
  EXPECT_GT(step.parts.inconsistency_sigmas, 6);
  EXPECT_EQ(state_.filter.accepted, 3U);
  EXPECT_LT(error(state_.filter.T_sensor_target, state_.filter.t_us).tail<3>().norm(), 2e-3);
}

TEST_F(TrackerPartsTest, TheModeBeginsWithoutMemoriesOfParts) {
  VERIFIES("LASSO-MOD-164~2");
  come_near();
  see(2, 1);
  EXPECT_TRUE(state_.parts.of[0].measured);
  change_mode(E::kFar, state_);
  EXPECT_TRUE(state_.parts.of[0].measured);
  change_mode(E::kNear, state_);
  EXPECT_FALSE(state_.parts.of[0].measured);
}

TEST_F(TrackerPartsTest, TheNextPartIsChosenForTheScanToBePlanned) {
  VERIFIES("LASSO-MOD-161~3");
  start(small_error());
  TrackStep step = track(0);
  EXPECT_EQ(next_part(mission_, parts_, kWhole, 2, 3 * test::kPeriodUs, step), kWhole) << "not in a mode of parts";
  step = track(1);
  ASSERT_EQ(step.after.mode, M::kShortRange);
  const PartNumber part = next_part(mission_, parts_, kWhole, 3, 3 * test::kPeriodUs, step);
  ASSERT_NE(part, kWhole);
  EXPECT_EQ(step.after.parts.of[part - 1U].last_asked_id, 3U);
  EXPECT_EQ(next_part(mission_, parts_, kWhole, 3, -1, step), kWhole) << "no prediction into the past";
}

}  // namespace
}  // namespace lasso
