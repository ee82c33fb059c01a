// The component's modes, starts and commands, as telemetry states them.
#include <cmath>

#include "ut/exec/mode_story.hpp"

namespace lasso {
namespace {

using test::code;
using test::ComponentScene;
using test::Story;
using test::story_parameters;
using M = TrackingMode;
using E = ModeEvent;

StartOffer offer_at(const ComponentScene& scene, TimeUs t_us, const Vec6& off = Vec6::Zero()) {
  const test::BoxScene truth = test::default_scene();
  Pose pose = truth.pose_at(t_us);
  pose.q = normalized(exp_so3(off.head<3>()) * pose.q);
  pose.p += off.tail<3>();
  return rough_offer(scene.component->mission().parameters, pose, truth.rates, t_us);
}

// Turned about the sensor's axis by 70 degrees: no turn that a box could be mistaken in, and 3.5 sigma off.
Vec6 wrong() {
  Vec6 off = Vec6::Zero();
  off[2] = 70 * kRadPerDeg;
  off[4] = 0.6;
  return off;
}

// And sure of itself.
StartOffer wrong_offer(const ComponentScene& scene, TimeUs t_us) {
  StartOffer offer = offer_at(scene, t_us, wrong());
  offer.covariance = 1e-4 * Mat6::Identity();
  return offer;
}

TEST(ModeManager, ABearingIsSoughtOverTheWholeField) {
  VERIFIES("LASSO-MOD-101~3 LASSO-MOD-136~4 LASSO-MOD-137~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 14);
  ASSERT_EQ(story.reports.size(), 12u);
  story.expect({{M::kStandby, E::kSeek, M::kBearing}});
  const PoseTelemetry& t = story.last();
  EXPECT_EQ(t.mode, code(M::kBearing));
  EXPECT_EQ(t.valid, 0);
  EXPECT_EQ(t.reason, static_cast<std::uint8_t>(PoseReason::kOnlyBearing));
  EXPECT_EQ(t.bearing_reason, 0);
  EXPECT_EQ(t.bearing_scans, 12u);
  EXPECT_NEAR(t.bearing[2], 2.5, 0.35);
  EXPECT_NEAR(t.plan_half_extents[0], std::tan(15 * kRadPerDeg), 1e-12);
  EXPECT_EQ(t.plan_center[0], 0);
  EXPECT_EQ(t.p_sensor_target_m[2], 0) << "no pose";
  EXPECT_EQ(t.filter_p_sensor_target_m[2], 0);
  scene.sensor.hidden = true;
  story.run(scene, 4);
  EXPECT_EQ(story.last().bearing_reason, static_cast<std::uint8_t>(BearingReason::kNothingSeen));
  EXPECT_EQ(story.last().bearing[2], 0) << "nothing stale";
}

TEST(ModeManager, NavigationIsTakenWhereAStartIsAwaited) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-132~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 3);
  EXPECT_TRUE(story.reports.empty()) << "standby waits for a command";
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 6);
  story.expect({{M::kStandby, E::kSeek, M::kBearing}, {M::kBearing, E::kStart, M::kStarting}, {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kNavigation));
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
}

TEST(ModeManager, AWrongHandOverIsRefusedAndTheNextWayIsTried) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-132~1 LASSO-MOD-133~4 LASSO-MOD-137~1");
  for (const bool recover : {true, false}) {
    MissionParameters p = story_parameters();
    p.recover = recover ? 1 : 0;
    ComponentScene scene(p);
    scene.begin();
    ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
    ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, wrong_offer(scene, 0)), StartRefusal::kNone);
    Story story;
    story.run(scene, 12);
    const M given_up = recover ? M::kBearing : M::kLost;
    story.expect({{M::kStandby, E::kStart, M::kStarting},
                  {M::kStarting, recover ? E::kRecover : E::kExhausted, given_up},
                  {given_up, E::kStart, M::kStarting},
                  {M::kStarting, E::kPoseValid, M::kTracking}});
    for (const PoseTelemetry& t : story.reports) EXPECT_TRUE(t.valid == 0 || scene.error(t).norm() < 1e-2);
    const PoseTelemetry& t = story.last();
    EXPECT_EQ(t.mode, code(M::kTracking));
    EXPECT_EQ(t.start_source, static_cast<std::uint8_t>(InitialPoseSource::kNavigation));
    EXPECT_EQ(t.refused_source, static_cast<std::uint8_t>(InitialPoseSource::kHandover));
    EXPECT_EQ(t.refusal, static_cast<std::uint8_t>(StartRefusal::kNotConfirmed));
    EXPECT_EQ(t.refused_starts, 1u);
  }
}

TEST(ModeManager, AWrongOfferCostsNoTrack) {
  VERIFIES("LASSO-MOD-185~1 LASSO-MOD-137~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 8);
  for (const int frame : {8, 10}) {  // the second one before the first is given up
    ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, wrong_offer(scene, frame * 200000)), StartRefusal::kNone);
    story.run(scene, 2);
  }
  story.run(scene, 10);
  story.expect({{M::kStandby, E::kStart, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking},
                {M::kTracking, E::kStart, M::kStarting},
                {M::kStarting, E::kStart, M::kStarting},
                {M::kStarting, E::kFallBack, M::kReacquiring},
                {M::kReacquiring, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kHandover));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotConfirmed));
  for (const PoseTelemetry& t : story.reports) EXPECT_TRUE(t.valid == 0 || scene.error(t).norm() < 1e-2);
}

TEST(ModeManager, AShortEclipseIsCoastedALongerOneRecoveredNearThePrediction) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-137~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 12);
  story.changes.clear();
  scene.sensor.hidden = true;
  story.run(scene, 5);
  scene.sensor.hidden = false;
  story.run(scene, 6);
  story.expect({{M::kTracking, E::kPoseInvalid, M::kCoasting},
                {M::kCoasting, E::kRecover, M::kReacquiring},
                {M::kReacquiring, E::kPoseValid, M::kTracking}});
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
}

TEST(ModeManager, ALongEclipseEndsInABearingAndANewStart) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-131~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 8);
  story.changes.clear();
  scene.sensor.hidden = true;
  story.run(scene, 14);
  story.expect({{M::kTracking, E::kPoseInvalid, M::kCoasting},
                {M::kCoasting, E::kRecover, M::kReacquiring},
                {M::kReacquiring, E::kRecover, M::kBearing}});
  EXPECT_EQ(story.last().bearing_reason, static_cast<std::uint8_t>(BearingReason::kNothingSeen));
  scene.sensor.hidden = false;
  story.run(scene, 4);
  EXPECT_EQ(story.last().bearing_reason, 0);
  EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kUplink)) << "the last track's";
  const TimeUs now_us = scene.component->next_slot_us();
  Vec6 far = Vec6::Zero();
  far[5] = 14;
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, now_us, far)), StartRefusal::kNotAtBearing);
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, now_us)), StartRefusal::kNone);
  story.run(scene, 5);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotAtBearing));
}

TEST(ModeManager, CommandsThatCannotBeAreRefusedByTheirName) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-173~2");
  ComponentScene scene(story_parameters());
  EXPECT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNotBegun);
  scene.begin();
  for (const M mode : {M::kStarting, M::kCoasting, M::kLost, M::kVerifying}) {
    EXPECT_EQ(scene.component->command_mode(mode), ModeRefusal::kNotByCommand) << to_string(mode);
  }
  for (const M mode : {M::kTracking, M::kShortRange}) {
    EXPECT_EQ(scene.component->command_mode(mode), ModeRefusal::kNotFromHere) << to_string(mode);
  }
  EXPECT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNoPrediction);
  EXPECT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone) << "it is there already";
  scene.run_frame();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  scene.run_frame();
  EXPECT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNotFromHere) << "starting";
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().refused_commands, 8u);
}

TEST(ModeManager, AnyModeCanBeCommanded) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-137~1 LASSO-MOD-173~2 LASSO-SYS-014~2");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 8);
  ASSERT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNone);
  story.run(scene, 4);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 4);
  EXPECT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone) << "it is there already";
  story.run(scene, 1);
  ASSERT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone);
  const std::size_t before = story.reports.size();
  story.run(scene, 4);
  EXPECT_EQ(story.reports.size(), before + 2) << "the scan before, and the change";
  EXPECT_EQ(story.last().mode, code(M::kStandby));
  story.expect({{M::kStandby, E::kStart, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking},
                {M::kTracking, E::kReacquire, M::kReacquiring},
                {M::kReacquiring, E::kPoseValid, M::kTracking},
                {M::kTracking, E::kSeek, M::kBearing},
                {M::kBearing, E::kStop, M::kStandby}});
}

TEST(ModeManager, AHeldModeStaysUntilItIsReleased) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-173~2");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  scene.component->hold_mode(true);
  Story story;
  story.run(scene, 4);
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kBearing));
  EXPECT_EQ(story.last().held, 1);
  scene.component->hold_mode(false);
  story.run(scene, 5);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().held, 0);
  scene.component->hold_mode(true);
  story.run(scene, 3);
  scene.sensor.hidden = true;
  story.run(scene, 12);
  EXPECT_EQ(story.last().mode, code(M::kCoasting)) << "beyond tracking.coast_frames";
  ASSERT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone) << "commands still work";
  story.run(scene, 3);
  EXPECT_EQ(story.last().mode, code(M::kStandby));
}

TEST(ModeManager, WrongOffersAreRefusedCountedAndTold) {
  VERIFIES("LASSO-MOD-134~3 LASSO-MOD-008~2 LASSO-SYS-011~2");
  ComponentScene scene(story_parameters());
  const StartOffer good = rough_offer(story_parameters(), test::default_scene().at_zero, {}, 0);
  EXPECT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, good), StartRefusal::kNotBegun);
  scene.begin();
  EXPECT_EQ(scene.component->offer_start(InitialPoseSource::kNone, good), StartRefusal::kNoSuchSource);
  EXPECT_EQ(scene.component->offer_start(static_cast<InitialPoseSource>(kInitialPoseSources), good), StartRefusal::kNoSuchSource);
  EXPECT_EQ(scene.component->offer_start(InitialPoseSource::kSearch, good), StartRefusal::kNoSuchSource) << "nobody offers it";
  StartOffer bad = good;
  bad.t_us = 1;  // the next boundary is at 0
  EXPECT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, bad), StartRefusal::kFromFuture);
  EXPECT_EQ(scene.component->start_tracking(good.T_sensor_target, good.rates, 1), Status::kBadValue);
  bad = good;
  bad.T_sensor_target.p.x() = std::nan("");
  EXPECT_EQ(scene.component->start_tracking(bad.T_sensor_target, good.rates, 0), Status::kNotFinite);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kBearing)) << "no offer was kept";
  EXPECT_EQ(story.last().refused_starts, 3u);
  EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kUplink));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotFinite));
}

TEST(ModeManager, WhatHasGrownOldIsRefusedWhenItsTurnComes) {
  VERIFIES("LASSO-MOD-133~4 LASSO-MOD-134~3");
  MissionParameters p = story_parameters();
  p.start_age_max_s = 1;
  ComponentScene scene(p);
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 7);
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kApriori, offer_at(scene, 7 * 200000)), StartRefusal::kNone);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 5);
  EXPECT_EQ(story.last().mode, code(M::kTracking)) << "from the next source in the same frame";
  EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kApriori));
  EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kNavigation));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kTooOld));
}

TEST(ModeManager, AMissionsOwnStartIsRefusedByItsReasonAndTheNextWayIsTried) {
  VERIFIES("LASSO-MOD-133~4 LASSO-MOD-134~3 LASSO-MOD-137~1 LASSO-MOD-008~2");
  MissionParameters behind = test::box_parameters(test::default_scene());
  behind.initial_z_m = -2.5;
  MissionParameters out_of_reach = test::box_parameters(test::default_scene());
  out_of_reach.initial_z_m = 5000;
  MissionParameters not_unit = test::box_parameters(test::default_scene());
  not_unit.initial_qw -= 0.3;
  const std::pair<MissionParameters, StartRefusal> cases[] = {
      {behind, StartRefusal::kOutOfReach}, {out_of_reach, StartRefusal::kOutOfReach}, {not_unit, StartRefusal::kNotUnit}};
  for (const auto& [p, refusal] : cases) {
    ComponentScene scene(p);
    scene.begin();
    ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
    Story story;
    story.run(scene, 6);
    story.expect(
        {{M::kStandby, E::kSeek, M::kBearing}, {M::kBearing, E::kStart, M::kStarting}, {M::kStarting, E::kPoseValid, M::kTracking}});
    EXPECT_EQ(story.last().mode, code(M::kTracking));
    EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kNavigation));
    EXPECT_EQ(story.last().refused_starts, 1u);
    EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kApriori));
    EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(refusal));
  }
}

// The last command counts, and the one before it is not tried later.
TEST(ModeManager, ACommandTakesThePlaceOfTheOneBefore) {
  VERIFIES("LASSO-MOD-131~1");
  ComponentScene scene(story_parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, offer_at(scene, 0)), StartRefusal::kNone);
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0, wrong())), StartRefusal::kNone);
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kUplink));
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kBearing)) << "the hand-over is not left to be tried";
}

// A command in each frame leaves no scan to be reported; the changes are reported all the same, in order, by packets of their own.
TEST(ModeManager, NoChangeOfTheModeGoesUntold) {
  VERIFIES("LASSO-MOD-137~1 LASSO-MOD-001~2 LASSO-SYS-014~2");
  ComponentScene scene(story_parameters());
  scene.begin();
  Story story;
  for (int i = 0; i < 30; ++i) {
    const TimeUs now_us = scene.component->next_slot_us();
    if (i % 2 == 0) {  // to bearing, and from there to a start in the same frame
      ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
      ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, offer_at(scene, now_us)), StartRefusal::kNone);
    } else {
      ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kUplink, offer_at(scene, now_us)), StartRefusal::kNone);
    }
    story.run(scene, 1);
  }
  story.run(scene, 6);
  ASSERT_GE(story.changes.size(), 45u);
  M mode = M::kStandby;
  for (const ModeChange& change : story.changes) {
    EXPECT_EQ(change.from, mode);
    EXPECT_EQ(next_mode(change.from, change.event), change.to);
    mode = change.to;
  }
  EXPECT_EQ(story.last().mode, code(mode));
}

}  // namespace
}  // namespace lasso
