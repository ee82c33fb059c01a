// The component's modes, starts and commands, as telemetry tells them.
#include <cmath>

#include "fsw/exec/component.hpp"
#include "ut/exec/component_scene.hpp"

namespace lasso {
namespace {

using test::ComponentScene;
using test::Report;
using M = TrackingMode;
using E = ModeEvent;

MissionParameters parameters() {
  MissionParameters p = test::box_parameters(test::default_scene());
  p.initial_present = 0;
  p.recover = 1;
  p.coast_frames = 2;
  p.reacquire_frames = 3;
  p.start_frames = 3;
  return p;
}

std::uint8_t code(M mode) { return static_cast<std::uint8_t>(mode); }

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

struct Story {
  std::vector<PoseTelemetry> reports;
  std::vector<ModeChange> changes;

  void take(const PoseTelemetry& t) {
    reports.push_back(t);
    for (std::size_t k = 0; k < t.changes; ++k) {
      changes.push_back({static_cast<M>(t.change_from[k]), static_cast<E>(t.change_event[k]), static_cast<M>(t.change_to[k])});
    }
  }
  void run(ComponentScene& scene, int frames) {
    for (int i = 0; i < frames; ++i) {
      for (const Report& report : scene.run_frame()) take(report.pose);
    }
  }
  void expect(const std::vector<ModeChange>& expected) const {
    ASSERT_EQ(changes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(changes[i].from, expected[i].from) << i << " " << to_string(changes[i].from);
      EXPECT_EQ(changes[i].event, expected[i].event) << i << " " << to_string(changes[i].event);
      EXPECT_EQ(changes[i].to, expected[i].to) << i << " " << to_string(changes[i].to);
    }
  }
  const PoseTelemetry& last() const { return reports.back(); }
};

TEST(ComponentModes, ABearingIsSoughtOverTheWholeField) {
  VERIFIES("LASSO-MOD-101~1 LASSO-MOD-136~2 LASSO-MOD-137~1");
  ComponentScene scene(parameters());
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

TEST(ComponentModes, NavigationIsTakenWhereAStartIsAwaited) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-132~1");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 3);
  EXPECT_TRUE(story.reports.empty()) << "standby waits for a command";
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 6);
  story.expect({{M::kStandby, E::kSeek, M::kBearing}, {M::kBearing, E::kStart, M::kStarting}, {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().start_way, static_cast<std::uint8_t>(StartWay::kNavigation));
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
}

TEST(ComponentModes, AWrongHandOverIsRefusedAndTheNextWayIsTried) {
  VERIFIES("LASSO-MOD-131~1 LASSO-MOD-132~1 LASSO-MOD-133~1 LASSO-MOD-137~1");
  for (const bool recover : {true, false}) {
    MissionParameters p = parameters();
    p.recover = recover ? 1 : 0;
    ComponentScene scene(p);
    scene.begin();
    ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
    StartOffer off = offer_at(scene, 0, wrong());
    off.covariance = 1e-4 * Mat6::Identity();  // and sure of itself
    ASSERT_EQ(scene.component->offer_start(StartWay::kHandover, off), StartRefusal::kNone);
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
    EXPECT_EQ(t.start_way, static_cast<std::uint8_t>(StartWay::kNavigation));
    EXPECT_EQ(t.refused_way, static_cast<std::uint8_t>(StartWay::kHandover));
    EXPECT_EQ(t.refusal, static_cast<std::uint8_t>(StartRefusal::kNotConfirmed));
    EXPECT_EQ(t.refused_starts, 1u);
  }
}

TEST(ComponentModes, AShortEclipseIsCoastedALongerOneRecoveredNearThePrediction) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-137~1");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
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

TEST(ComponentModes, ALongEclipseEndsInABearingAndANewStart) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-131~1");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
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
  EXPECT_EQ(story.last().start_way, static_cast<std::uint8_t>(StartWay::kUplink)) << "the last track's";
  const TimeUs now_us = scene.component->next_slot_us();
  Vec6 far = Vec6::Zero();
  far[5] = 14;
  ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, now_us, far)), StartRefusal::kNotAtBearing);
  ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, now_us)), StartRefusal::kNone);
  story.run(scene, 5);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotAtBearing));
}

TEST(ComponentModes, CommandsThatCannotBeAreRefusedByTheirName) {
  VERIFIES("LASSO-MOD-136~2");
  ComponentScene scene(parameters());
  EXPECT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNotBegun);
  scene.begin();
  EXPECT_EQ(scene.component->command_mode(M::kTracking), ModeRefusal::kNotByCommand);
  EXPECT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNoPrediction);
  EXPECT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone) << "it is there already";
  scene.run_frame();
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  scene.run_frame();
  EXPECT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNotFromHere) << "starting";
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().refused_commands, 3u);
}

TEST(ComponentModes, AnyModeCanBeCommanded) {
  VERIFIES("LASSO-MOD-136~2 LASSO-MOD-137~1");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
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

TEST(ComponentModes, AHeldModeStaysUntilItIsReleased) {
  VERIFIES("LASSO-MOD-136~2");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  scene.component->hold_mode(true);
  Story story;
  story.run(scene, 4);
  ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
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

TEST(ComponentModes, WrongOffersAreRefusedCountedAndTold) {
  VERIFIES("LASSO-MOD-134~1 LASSO-MOD-008~1");
  ComponentScene scene(parameters());
  const StartOffer good = rough_offer(parameters(), test::default_scene().at_zero, {}, 0);
  EXPECT_EQ(scene.component->offer_start(StartWay::kUplink, good), StartRefusal::kNotBegun);
  scene.begin();
  EXPECT_EQ(scene.component->offer_start(StartWay::kNone, good), StartRefusal::kNoSuchWay);
  EXPECT_EQ(scene.component->offer_start(static_cast<StartWay>(kStartWays), good), StartRefusal::kNoSuchWay);
  EXPECT_EQ(scene.component->offer_start(StartWay::kSearch, good), StartRefusal::kNoSuchWay) << "nobody offers it";
  StartOffer bad = good;
  bad.t_us = 1;  // the next boundary is at 0
  EXPECT_EQ(scene.component->offer_start(StartWay::kHandover, bad), StartRefusal::kFromFuture);
  EXPECT_EQ(scene.component->start_tracking(good.T_sensor_target, good.rates, 1), Status::kBadValue);
  bad = good;
  bad.T_sensor_target.p.x() = std::nan("");
  EXPECT_EQ(scene.component->start_tracking(bad.T_sensor_target, good.rates, 0), Status::kNotFinite);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kBearing)) << "no offer was kept";
  EXPECT_EQ(story.last().refused_starts, 3u);
  EXPECT_EQ(story.last().refused_way, static_cast<std::uint8_t>(StartWay::kUplink));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotFinite));
}

TEST(ComponentModes, WhatHasGrownOldIsRefusedWhenItsTurnComes) {
  VERIFIES("LASSO-MOD-133~1 LASSO-MOD-134~1");
  MissionParameters p = parameters();
  p.start_age_max_s = 1;
  ComponentScene scene(p);
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 7);
  ASSERT_EQ(scene.component->offer_start(StartWay::kApriori, offer_at(scene, 7 * 200000)), StartRefusal::kNone);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 5);
  EXPECT_EQ(story.last().mode, code(M::kTracking)) << "by the next way in the same frame";
  EXPECT_EQ(story.last().start_way, static_cast<std::uint8_t>(StartWay::kApriori));
  EXPECT_EQ(story.last().refused_way, static_cast<std::uint8_t>(StartWay::kNavigation));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kTooOld));
}

TEST(ComponentModes, AMissionsOwnStartIsValidatedToo) {
  VERIFIES("LASSO-MOD-134~1");
  MissionParameters p = parameters();
  p.initial_present = 1;
  p.initial_z_m = -2.5;
  ComponentScene scene(p);
  ASSERT_EQ(scene.load().status, Status::kOk);
  EXPECT_EQ(scene.component->begin(0), Status::kBadValue);
}

// The last command counts, and the one before it is not tried later.
TEST(ComponentModes, ACommandTakesThePlaceOfTheOneBefore) {
  VERIFIES("LASSO-MOD-131~1");
  ComponentScene scene(parameters());
  scene.begin();
  ASSERT_EQ(scene.component->offer_start(StartWay::kHandover, offer_at(scene, 0)), StartRefusal::kNone);
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0, wrong())), StartRefusal::kNone);
  ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 4);
  EXPECT_EQ(story.last().start_way, static_cast<std::uint8_t>(StartWay::kUplink));
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 4);
  EXPECT_EQ(story.last().mode, code(M::kBearing)) << "the hand-over is not left to be tried";
}

MissionParameters search_parameters() {
  MissionParameters p = test::box_parameters(test::uneven_scene());
  p.initial_present = 0;
  p.recover = 1;
  p.start_fifth = static_cast<double>(StartWay::kSearch);
  p.points = 400;
  p.search_slice = 700000;
  return p;
}

TEST(ComponentModes, TheTargetIsFoundWithoutAnyPriorAndTracked) {
  VERIFIES("LASSO-MOD-123~1 LASSO-MOD-111~1 LASSO-MOD-131~1 LASSO-MOD-137~1");
  ComponentScene scene(search_parameters(), test::uneven_scene());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 16);
  story.expect({{M::kStandby, E::kSeek, M::kBearing},
                {M::kBearing, E::kSearch, M::kSearching},
                {M::kSearching, E::kPoseValid, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().start_way, static_cast<std::uint8_t>(StartWay::kSearch));
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
  for (const PoseTelemetry& t : story.reports) EXPECT_TRUE(t.valid == 0 || scene.error(t).norm() < 1e-2);
}

TEST(ComponentModes, ALostTargetIsLookedForNearItsPredictionThenSearched) {
  VERIFIES("LASSO-MOD-142~1");
  MissionParameters p = search_parameters();
  p.coast_frames = 2;
  p.reacquire_frames = 2;
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  const test::BoxScene truth = test::uneven_scene();
  ASSERT_EQ(scene.component->start_tracking(truth.at_zero, truth.rates, 0), Status::kOk);
  Story story;
  story.run(scene, 6);
  story.changes.clear();
  scene.sensor.hidden = true;
  story.run(scene, 10);
  scene.sensor.hidden = false;
  story.run(scene, 16);
  story.expect({{M::kTracking, E::kPoseInvalid, M::kCoasting},
                {M::kCoasting, E::kRecover, M::kReacquiring},
                {M::kReacquiring, E::kRecover, M::kBearing},
                {M::kBearing, E::kSearch, M::kSearching},
                {M::kSearching, E::kPoseValid, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
}

// A box looks alike from several sides: never a guess, and the candidates are told.
TEST(ComponentModes, AnAmbiguousTargetIsNeverTracked) {
  VERIFIES("LASSO-MOD-124~1 LASSO-MOD-120~1 LASSO-MOD-136~2");
  MissionParameters p = parameters();
  p.points = 400;
  p.search_slice = 1e7;
  p.search_frames = 3;
  ComponentScene scene(p);
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kSearching), ModeRefusal::kNone);
  Story story;
  story.run(scene, 3);
  EXPECT_NEAR(story.last().plan_half_extents[0], std::tan(15 * kRadPerDeg), 1e-12) << "no bearing yet";
  story.run(scene, 3);
  EXPECT_LT(story.last().plan_half_extents[0], 0.9 * std::tan(15 * kRadPerDeg)) << "around the bearing";
  EXPECT_EQ(story.last().reason, static_cast<std::uint8_t>(PoseReason::kSearching));
  EXPECT_EQ(story.last().search_outcome, static_cast<std::uint8_t>(SearchOutcome::kAmbiguous));
  EXPECT_GE(story.last().search_candidates, 2);
  EXPECT_EQ(story.last().bearing_reason, 0) << "renewed by the same scans";
  story.run(scene, 3);
  story.expect({{M::kStandby, E::kSearch, M::kSearching}, {M::kSearching, E::kRecover, M::kBearing}});
  EXPECT_EQ(story.last().search_outcome, 0) << "nothing stale";
}

TEST(ComponentModes, ASearchThatIsAlwaysLateEnds) {
  VERIFIES("LASSO-MOD-136~2 LASSO-EXE-003~1");
  MissionParameters p = parameters();
  p.search_frames = 3;
  ComponentScene scene(p);
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kSearching), ModeRefusal::kNone);
  Story story;
  for (int frame = 0; frame < 8; ++frame) {
    for (const Report& report : scene.run_frame(frame % 2 == 1)) story.take(report.pose);
  }
  story.expect({{M::kStandby, E::kSearch, M::kSearching}, {M::kSearching, E::kRecover, M::kBearing}});
}

TEST(ComponentModes, ASearchTrustsNoOldBearing) {
  VERIFIES("LASSO-MOD-136~2");
  MissionParameters p = parameters();
  p.bearing_memory_s = 1;
  ComponentScene scene(p);
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 4);
  const test::BoxScene truth = test::default_scene();
  ASSERT_EQ(scene.component->start_tracking(truth.at_zero, truth.rates, 0), Status::kOk);
  story.run(scene, 10);
  ASSERT_EQ(scene.component->command_mode(M::kSearching), ModeRefusal::kNone);
  story.run(scene, 3);
  EXPECT_NEAR(story.last().plan_half_extents[0], std::tan(15 * kRadPerDeg), 1e-12);
}

TEST(ComponentModes, APoseThatWasFoundTooLateIsRefusedByItsName) {
  VERIFIES("LASSO-MOD-134~1");
  MissionParameters p = search_parameters();
  p.start_age_max_s = 0;
  p.search_scans_max = 1;
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 12);
  EXPECT_EQ(story.last().mode, code(M::kSearching));
  EXPECT_GE(story.last().refused_starts, 1u);
  EXPECT_EQ(story.last().refused_way, static_cast<std::uint8_t>(StartWay::kSearch));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kTooOld));
}

// A command in each frame leaves no scan to be reported; the changes are told all the same, in order, by packets of their own.
TEST(ComponentModes, NoChangeOfTheModeGoesUntold) {
  VERIFIES("LASSO-MOD-137~1");
  ComponentScene scene(parameters());
  scene.begin();
  Story story;
  for (int i = 0; i < 30; ++i) {
    const TimeUs now_us = scene.component->next_slot_us();
    if (i % 2 == 0) {  // to bearing, and from there to a start in the same frame
      ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
      ASSERT_EQ(scene.component->offer_start(StartWay::kNavigation, offer_at(scene, now_us)), StartRefusal::kNone);
    } else {
      ASSERT_EQ(scene.component->offer_start(StartWay::kUplink, offer_at(scene, now_us)), StartRefusal::kNone);
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
