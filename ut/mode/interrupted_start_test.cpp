// The track that a start interrupts, and is given back if the start is refused (LASSO-MOD-185).
#include "ut/mode/start_check_fixture.hpp"

namespace lasso {
namespace {

using test::small_error;
using test::StartCheckTest;
using Stage = StartCheck::Stage;

class InterruptedTest : public StartCheckTest {
 protected:
  void SetUp() override {
    others_ = test::uneven_scene().others;
    load_with_others(0.9);
    mission_.parameters.start_frames = 1;
    mission_.parameters.recover = 0;
    start(small_error());
    track_view(0);
    track_view(1);
    ASSERT_EQ(state_.mode, TrackingMode::kTracking);
    tracked_ = state_.filter;
  }
  void offer_wrong_start() {
    Pose wrong = scene_.at_zero;
    wrong.q = normalized(exp_so3(Vec3(0, 0, kPi)) * wrong.q);
    StartOffer offer = rough_offer(mission_.parameters, wrong, Twist{}, 0);
    ASSERT_EQ(start_track(mission_, InitialPoseSource::kHandover, offer, 1400000, state_), StartRefusal::kNone);
  }

  FilterState tracked_;
};

TEST_F(InterruptedTest, AStartThatNoScanConfirmsGivesTheTrackBackThatItInterrupted) {
  VERIFIES("LASSO-MOD-185~1");
  offer_wrong_start();
  EXPECT_EQ(track_view(2).event, ModeEvent::kPoseInvalid);
  const TrackStep given_up = track_view(3);
  EXPECT_EQ(given_up.event, ModeEvent::kFallBack);
  EXPECT_EQ(given_up.after.mode, TrackingMode::kReacquiring);
  EXPECT_FALSE(given_up.after.interrupts);
  state_.filter = tracked_;  // as its keeper does
  const TrackStep found = track_view(4);
  EXPECT_EQ(found.after.mode, TrackingMode::kTracking) << to_string(found.registration.reason);
  EXPECT_LT(error(found.after.filter.T_sensor_target, 0).norm(), 5e-3);
}

TEST_F(InterruptedTest, AnotherWrongStartInterruptsTheSameTrack) {
  VERIFIES("LASSO-MOD-185~1");
  offer_wrong_start();
  offer_wrong_start();
  EXPECT_TRUE(state_.interrupts);
}

// Also one that is checked already: the track before it is the one that is kept.
TEST_F(InterruptedTest, AStartThatIsCheckedKeepsTheTrackThatItInterrupted) {
  VERIFIES("LASSO-MOD-185~1 LASSO-MOD-188~2");
  mission_.parameters.start_check = 1;
  mission_.parameters.search_slice = 1000;
  start(small_error());
  ASSERT_EQ(frame(2).after.mode, TrackingMode::kVerifying);
  EXPECT_TRUE(state_.interrupts);
  const TrackState verifying = state_;
  EXPECT_EQ(frame(3, true).after.mode, TrackingMode::kVerifying);
  EXPECT_EQ(frame(4, true).event, ModeEvent::kFallBack) << "after start.frames";
  EXPECT_EQ(state_.mode, TrackingMode::kReacquiring);
  state_ = verifying;
  start(small_error());
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_TRUE(state_.interrupts);
}

TEST_F(InterruptedTest, AConfirmedStartForgetsTheTrackBefore) {
  VERIFIES("LASSO-MOD-185~1");
  start(small_error());
  EXPECT_TRUE(state_.interrupts);
  EXPECT_EQ(track_view(2).after.mode, TrackingMode::kTracking);
  EXPECT_FALSE(state_.interrupts);
}

TEST_F(InterruptedTest, WhatWasNoTrackIsNotFallenBackTo) {
  VERIFIES("LASSO-MOD-185~1");
  for (const ModeEvent event : {ModeEvent::kSeek, ModeEvent::kSearch, ModeEvent::kStop}) {
    const TrackState before = state_;
    change_mode(event, state_);
    state_.filter = tracked_;  // whatever may be left of one
    offer_wrong_start();
    EXPECT_FALSE(state_.interrupts) << to_string(event);
    state_ = before;
  }
  state_.filter.initialised = false;  // its prediction had no meaning any more
  offer_wrong_start();
  EXPECT_FALSE(state_.interrupts);
}

}  // namespace
}  // namespace lasso
