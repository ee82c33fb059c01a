// A start whose scan is searched for a better pose before it is believed (start.check).
#include "ut/mode/start_check_fixture.hpp"

namespace lasso {
namespace {

using test::small_error;
using test::StartCheckTest;
using Stage = StartCheck::Stage;

TEST_F(StartCheckTest, ARightStartIsBelievedOnceTheSearchHasFoundNothingElse) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-132~1 LASSO-MOD-188~2 LASSO-MOD-003~3 LASSO-MOD-118~2");
  mission_.parameters.search_slice = 200000;
  start(small_error());
  std::uint32_t k = 0;
  TrackStep step = frame(k);
  for (; step.registration.reason == PoseReason::kUnchecked && k < 100; step = frame(++k)) {
    ASSERT_EQ(step.after.mode, TrackingMode::kVerifying);
    EXPECT_EQ(step.event, k == 0 ? ModeEvent::kCheck : ModeEvent::kPoseInvalid);
    EXPECT_EQ(step.after.missed, 0) << "none of start.frames is used up";
    EXPECT_EQ(step.after.searches, 1u);
  }
  EXPECT_GT(k, 4u) << "half a frame's work in each";
  const std::uint32_t half = frame_work(mission_.parameters) / 2;
  EXPECT_GT(step.search.work, (k - 1) * half);
  EXPECT_LE(step.search.work, k * (half + kLargestStep));
  EXPECT_TRUE(step.registration.valid()) << to_string(step.registration.reason);
  EXPECT_EQ(step.event, ModeEvent::kPoseValid);
  EXPECT_EQ(step.after.mode, TrackingMode::kTracking);
  EXPECT_EQ(step.after.check.stage, Stage::kNone);
  EXPECT_NE(step.search.outcome, SearchOutcome::kNone) << "what it found is reported";
  EXPECT_EQ(step.after.filter.accepted, k) << "the track was followed meanwhile";
  EXPECT_LT(error(step.after.filter.T_sensor_target, 0).norm(), 5e-3);
}

// The limit is that of the axis that is known worst.
TEST_F(StartCheckTest, AStartWhoseAttitudeIsKnownIsBelievedAtOnce) {
  VERIFIES("LASSO-MOD-184~5");
  StartOffer offer = rough_offer(mission_.parameters, scene_.at_zero, {}, 0);
  offer.covariance.diagonal().head<3>() = kKnownAttitude_rad * kKnownAttitude_rad * Vec3(0.1, 0.2, 0.99);
  ASSERT_EQ(start_track(mission_, InitialPoseSource::kHandover, offer, 0, state_), StartRefusal::kNone);
  EXPECT_TRUE(frame(0).registration.valid());
  EXPECT_EQ(state_.mode, TrackingMode::kTracking);
  offer.covariance(2, 2) = 1.01 * kKnownAttitude_rad * kKnownAttitude_rad;
  state_ = TrackState();
  ASSERT_EQ(start_track(mission_, InitialPoseSource::kHandover, offer, 0, state_), StartRefusal::kNone);
  mission_.parameters.search_slice = 1000;
  EXPECT_EQ(frame(0).registration.reason, PoseReason::kUnchecked);
}

TEST_F(StartCheckTest, AWrongStartThatItsScanConfirmsIsContradicted) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-182~2 LASSO-MOD-134~3");
  const TrackStep step = verdict_on_deceptive_start();
  EXPECT_EQ(step.registration.reason, PoseReason::kContradicted);
  EXPECT_EQ(step.refusal, StartRefusal::kContradicted);
  EXPECT_EQ(step.event, ModeEvent::kExhausted);
  EXPECT_EQ(step.after.mode, TrackingMode::kLost) << "without waiting for start.frames";
  EXPECT_EQ(step.after.check.stage, Stage::kNone);
}

TEST_F(StartCheckTest, AVerdictInAFrameWhoseScanIsLostRefusesTheStartAndTellsOfTheScan) {
  VERIFIES("LASSO-MOD-184~5");
  const TrackStep step = verdict_on_deceptive_start(true);
  EXPECT_EQ(step.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(step.refusal, StartRefusal::kContradicted);
  EXPECT_EQ(step.after.mode, TrackingMode::kLost);
}

// A search that is rejected tells all the same what explains the scan far better.
TEST_F(StartCheckTest, AWrongStartIsContradictedByASearchThatIsRejected) {
  VERIFIES("LASSO-MOD-184~5");
  SearchLimits limits;
  limits.hits_min = 1e6;
  searcher_ = std::make_unique<Searcher>(limits);
  const TrackStep step = verdict_on_deceptive_start();
  EXPECT_EQ(step.search.outcome, SearchOutcome::kRejected);
  EXPECT_EQ(step.registration.reason, PoseReason::kContradicted);
}

TEST_F(StartCheckTest, AHeldStartThatIsContradictedIsNotBelievedEither) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-188~2");
  const Vec3 axis = deceptive_axis();
  start_turned(axis);
  state_.held = true;
  for (std::uint32_t k = 1; k < 6; ++k) {
    const TrackStep step = frame(k);
    const bool begins = k % 2 == 1;
    EXPECT_EQ(step.registration.reason, begins ? PoseReason::kUnchecked : PoseReason::kContradicted) << k;
    EXPECT_EQ(step.after.mode, begins ? TrackingMode::kVerifying : TrackingMode::kStarting) << k;
    EXPECT_EQ(step.event, begins ? ModeEvent::kCheck : ModeEvent::kConfirmAnew) << k;
    EXPECT_EQ(step.after.missed, begins ? 0 : UINT16_MAX) << "given up where it is not held any more";
  }
}

// Nothing in a scan can tell the poses of a symmetric target apart: the start decides, once a second scan says no more than the first.
TEST_F(StartCheckTest, AStartIsBelievedWhoseCompetitorsExplainTheScanAsWell) {
  VERIFIES("LASSO-MOD-184~5");
  load(test::box_parameters(scene_));
  mission_.parameters.start_check = 1;
  mission_.parameters.search_slice = 2e7;
  others_.clear();
  Pose half_turn;
  half_turn.q = exp_so3(kPi * Vec3::UnitY());
  half_turn.p = scene_.box.center - rotate(half_turn.q, scene_.box.center);
  ASSERT_EQ(start_at(scene_.at_zero * half_turn, Twist{}, 0, 0), StartRefusal::kNone);
  EXPECT_EQ(frame(0).after.check.stage, Stage::kSearching);
  EXPECT_EQ(frame(1).after.check.stage, Stage::kNone);
  EXPECT_EQ(frame(2, true).after.check.stage, Stage::kNone) << "without a scan";
  EXPECT_EQ(state_.mode, TrackingMode::kVerifying);
  const TrackStep second = frame(3);
  EXPECT_EQ(second.registration.reason, PoseReason::kUnchecked);
  EXPECT_EQ(second.after.check.stage, Stage::kSearching);
  EXPECT_EQ(second.after.searches, 2u);
  EXPECT_EQ(frame(4).after.mode, TrackingMode::kTracking);
}

TEST_F(StartCheckTest, TheSecondSearchHasTheLastWordWhereTheFirstIsUndecided) {
  VERIFIES("LASSO-MOD-184~5");
  mission_.parameters.search_slice = 1000;
  start(small_error());
  const TrackStep searching = frame(0);
  ASSERT_EQ(searching.registration.reason, PoseReason::kUnchecked);
  const auto second_word = [&](CheckOutcome verdict) {
    TrackStep step = searching;
    end_check(mission_.parameters, CheckOutcome::kUndecided, step);
    EXPECT_EQ(step.after.check.stage, Stage::kNone);
    EXPECT_EQ(step.after.mode, TrackingMode::kVerifying);
    EXPECT_EQ(step.registration.reason, PoseReason::kUnchecked);
    step.after.check.stage = Stage::kSearching;
    end_check(mission_.parameters, verdict, step);
    return step;
  };
  EXPECT_EQ(second_word(CheckOutcome::kSure).after.mode, TrackingMode::kTracking);
  EXPECT_EQ(second_word(CheckOutcome::kUndecided).after.mode, TrackingMode::kTracking);
  const TrackStep refused = second_word(CheckOutcome::kContradicted);
  EXPECT_EQ(refused.refusal, StartRefusal::kContradicted);
  EXPECT_NE(refused.after.mode, TrackingMode::kTracking);
}

TEST_F(StartCheckTest, AnImplausibleScanEndsACheckThatWaitsForItsSecondSearch) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-009~2 LASSO-MOD-188~2");
  follow_unchecked();
  ASSERT_EQ(state_.mode, TrackingMode::kVerifying);
  state_.check.stage = Stage::kNone;
  state_.check.undecided = true;
  scene_.at_zero.p += Vec3(0.006, -0.004, 0.007);
  const TrackStep jumped = frame(10);
  EXPECT_EQ(jumped.registration.reason, PoseReason::kImplausible);
  EXPECT_EQ(jumped.event, ModeEvent::kConfirmAnew);
  EXPECT_EQ(jumped.after.mode, TrackingMode::kStarting);
  EXPECT_EQ(jumped.after.missed, 1) << "the start's frames count on";
  EXPECT_FALSE(jumped.after.check.undecided);
}

TEST_F(StartCheckTest, WhatWasSearchedOrIsFoundNearItsPredictionIsNotChecked) {
  VERIFIES("LASSO-MOD-184~5");
  start(small_error());
  state_.source = InitialPoseSource::kSearch;
  EXPECT_EQ(try_frame(0).after.mode, TrackingMode::kTracking);
  state_.source = InitialPoseSource::kUplink;
  EXPECT_EQ(try_frame(0).after.searches, 1u);
  change_mode(ModeEvent::kPoseValid, state_);
  change_mode(ModeEvent::kReacquire, state_);
  EXPECT_EQ(try_frame(0).after.mode, TrackingMode::kTracking) << "reacquiring";
  mission_.parameters.start_check = 0;
  state_ = TrackState{};
  start(small_error());
  EXPECT_EQ(try_frame(0).after.mode, TrackingMode::kTracking) << "not asked for";
}

// The verdict comes in a frame whose scan is lost: the next one confirms the start without another search.
TEST_F(StartCheckTest, ALostScanDelaysTheVerdictAndCountsAsOne) {
  VERIFIES("LASSO-MOD-184~5");
  mission_.parameters.search_slice = 1000;
  start(small_error());
  frame(0);
  mission_.parameters.search_slice = 2e7;
  const TrackStep lost = frame(1, true);
  EXPECT_EQ(lost.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(lost.after.check.stage, Stage::kPassed);
  EXPECT_EQ(lost.after.missed, 1);
  const TrackStep next = frame(2);
  EXPECT_EQ(next.after.mode, TrackingMode::kTracking);
  EXPECT_EQ(next.after.searches, 1u);
}

// Each scan that would confirm the start gives it all of start.frames again.
TEST_F(StartCheckTest, ScansThatAreLostUseUpTheFramesOfAStartOnlyInARow) {
  VERIFIES("LASSO-MOD-184~5");
  mission_.parameters.search_slice = 1000;
  start(small_error());
  frame(0);
  std::uint32_t k = 1;
  for (int round = 0; round < 2; ++round) {
    for (int lost = 0; lost < 4; ++lost) ASSERT_EQ(frame(k++, true).after.mode, TrackingMode::kVerifying);
    ASSERT_EQ(frame(k++).registration.reason, PoseReason::kUnchecked) << round;
  }
}

// The search speaks of the pose that was confirmed, not of one that the scans have left for: that has to be confirmed by itself.
TEST_F(StartCheckTest, ATrackThatItsScansContradictIsConfirmedAndCheckedAnew) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-009~2 LASSO-MOD-188~2");
  follow_unchecked();
  std::uint32_t k = 10;
  mission_.parameters.search_slice = 2e7;
  scene_.at_zero.p += Vec3(0.006, -0.004, 0.007);
  const TrackStep jumped = frame(k++);
  EXPECT_EQ(jumped.registration.reason, PoseReason::kImplausible);
  EXPECT_EQ(jumped.after.mode, TrackingMode::kStarting);
  TrackStep anew = frame(k++);
  for (; anew.registration.reason == PoseReason::kFarFromStart; anew = frame(k++)) EXPECT_EQ(anew.after.mode, TrackingMode::kStarting);
  EXPECT_EQ(anew.registration.reason, PoseReason::kUnchecked);
  EXPECT_EQ(anew.after.mode, TrackingMode::kVerifying);
  EXPECT_EQ(anew.after.searches, 2u);
  EXPECT_LT(error(anew.after.check.T_sensor_target, 0).norm(), 5e-3);
  EXPECT_EQ(frame(k).after.mode, TrackingMode::kTracking);
}

// A frame that is not ready at its boundary is dropped whole: the check that it began has no scan, and the next scan begins another.
TEST_F(StartCheckTest, ACheckWhoseFrameWasDroppedBeginsAnew) {
  VERIFIES("LASSO-MOD-184~5 LASSO-EXE-003~1 LASSO-MOD-188~2");
  mission_.parameters.search_slice = 1000;
  start(small_error());
  const TrackStep dropped = try_frame(0);
  ASSERT_EQ(dropped.after.check.stage, Stage::kSearching);
  const TrackStep begun = frame(1);
  EXPECT_EQ(begun.after.check.stage, Stage::kSearching);
  EXPECT_EQ(begun.after.searches, dropped.after.searches) << "as if it had been the first";
  ++state_.searches;
  const TrackState before = state_;
  const TrackStep gone = frame(2);
  EXPECT_EQ(gone.after.mode, TrackingMode::kStarting) << "another search was begun, of which this is not the scan";
  EXPECT_EQ(gone.event, ModeEvent::kConfirmAnew);
  mission_.parameters.search_slice = 2e7;
  EXPECT_EQ(frame(3).registration.reason, PoseReason::kUnchecked);
  EXPECT_EQ(frame(4).after.mode, TrackingMode::kTracking);
  state_ = before;
  ++state_.searches;
  EXPECT_EQ(frame(2, true).after.mode, TrackingMode::kStarting);
}

// The frame that would begin the check has nothing to search: the next scan is asked.
TEST_F(StartCheckTest, ACheckWithoutAScanDoesNotBegin) {
  VERIFIES("LASSO-MOD-188~2");
  start(small_error());
  TrackStep step = track_view(0);
  ASSERT_EQ(step.after.mode, TrackingMode::kVerifying);
  searcher_->check(mission_, nullptr, *workspace_, step);
  EXPECT_EQ(step.after.mode, TrackingMode::kStarting);
  EXPECT_EQ(next_mode(TrackingMode::kStarting, step.event), step.after.mode) << "as the table has it";
}

// The check of a frame that was dropped has the number that the next search gets.
TEST_F(StartCheckTest, ASearchDoesNotGoOnWithACheck) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-111~1");
  start(small_error());
  ASSERT_EQ(try_frame(0).after.searches, 1u);
  change_mode(ModeEvent::kSearch, state_);
  ASSERT_EQ(state_.searches, 1u);
  TrackStep step;
  step.after = state_;
  searcher_->work(mission_, nullptr, *workspace_, step);
  EXPECT_EQ(step.search.work, 0u);
}

TEST_F(StartCheckTest, AnotherStartBeginsItsOwnCheck) {
  VERIFIES("LASSO-MOD-184~5");
  mission_.parameters.search_slice = 1000;
  start(small_error());
  frame(0);
  start(small_error());
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_EQ(state_.check.stage, Stage::kNone);
  EXPECT_EQ(frame(1).after.searches, 2u);
}

}  // namespace
}  // namespace lasso
