// The component's search for a target of which nothing is known, as telemetry states it.
#include <cmath>

#include "ut/exec/mode_story.hpp"

namespace lasso {
namespace {

using test::code;
using test::ComponentScene;
using test::Report;
using test::run_shifted;
using test::Story;
using test::story_parameters;
using M = TrackingMode;
using E = ModeEvent;

MissionParameters search_parameters() {
  MissionParameters p = test::box_parameters(test::uneven_scene());
  p.initial_present = 0;
  p.recover = 1;
  p.start_fifth = static_cast<double>(InitialPoseSource::kSearch);
  p.points = 400;
  p.search_slice = 700000;
  return p;
}

TEST(ComponentSearch, TheTargetIsFoundWithoutAnyPriorAndTracked) {
  VERIFIES("LASSO-MOD-123~4 LASSO-MOD-111~1 LASSO-MOD-131~1 LASSO-MOD-137~1");
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
  EXPECT_EQ(story.last().start_source, static_cast<std::uint8_t>(InitialPoseSource::kSearch));
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
  for (const PoseTelemetry& t : story.reports) EXPECT_TRUE(t.valid == 0 || scene.error(t).norm() < 1e-2);
}

TEST(ComponentSearch, AMissionsOwnStartThatCannotBeRightGivesPlaceToTheSearch) {
  VERIFIES("LASSO-MOD-133~4 LASSO-MOD-134~3");
  MissionParameters p = search_parameters();
  p.initial_present = 1;
  p.initial_z_m = 5000;
  p.recover = 0;
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  Story story;
  story.run(scene, 16);
  story.expect({{M::kStandby, E::kSeek, M::kBearing},
                {M::kBearing, E::kSearch, M::kSearching},
                {M::kSearching, E::kPoseValid, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kOutOfReach));
}

// Without recovery, too: a hand-over that no scan confirms leaves the search, whose turn comes in bearing.
TEST(ComponentSearch, AWrongHandOverGivesPlaceToTheSearch) {
  VERIFIES("LASSO-MOD-133~4 LASSO-MOD-137~1");
  MissionParameters p = search_parameters();
  p.recover = 0;
  p.start_frames = 2;
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  const test::BoxScene truth = test::uneven_scene();
  Pose wrong = truth.at_zero;
  wrong.q = normalized(exp_so3(Vec3(0, 0, 70 * kRadPerDeg)) * wrong.q);
  wrong.p.y() += 0.6;
  StartOffer offer = rough_offer(p, wrong, truth.rates, 0);
  offer.covariance = 1e-4 * Mat6::Identity();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, offer), StartRefusal::kNone);
  Story story;
  story.run(scene, 22);
  story.expect({{M::kStandby, E::kStart, M::kStarting},
                {M::kStarting, E::kRecover, M::kBearing},
                {M::kBearing, E::kSearch, M::kSearching},
                {M::kSearching, E::kPoseValid, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kNotConfirmed));
  EXPECT_LT(scene.error(story.last()).norm(), 1e-2);
}

// A start end for end that a scan would confirm: a search of this scan says otherwise, and the search's turn comes.
TEST(ComponentSearch, AStartThatASearchOfItsScanContradictsIsNeverTracked) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-133~4 LASSO-MOD-137~1");
  MissionParameters p = search_parameters();
  p.start_check = 1;
  p.start_inlier_share_min = p.inlier_share_min = p.agreement_min = 0;
  p.noise_tolerance = 1000;
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  Pose wrong = test::uneven_scene().at_zero;
  wrong.q = wrong.q * exp_so3(Vec3(kPi, 0, 0));
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, rough_offer(p, wrong, {}, 0)), StartRefusal::kNone);
  Story story;
  story.run(scene, 28);
  story.expect({{M::kStandby, E::kStart, M::kStarting},
                {M::kStarting, E::kCheck, M::kVerifying},
                {M::kVerifying, E::kRecover, M::kBearing},
                {M::kBearing, E::kSearch, M::kSearching},
                {M::kSearching, E::kPoseValid, M::kStarting},
                {M::kStarting, E::kPoseValid, M::kTracking}});
  EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kHandover));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kContradicted));
  EXPECT_EQ(story.last().refused_starts, 1u);
  for (const PoseTelemetry& t : story.reports) EXPECT_TRUE(t.valid == 0 || scene.error(t).norm() < 5e-2);
}

// A start is searched for a better pose, in some frames.
MissionParameters checked_parameters() {
  MissionParameters p = search_parameters();
  p.start_check = 1;
  p.search_slice = 200000;
  return p;
}

StartRefusal begin_with_right_start(ComponentScene& scene) {
  scene.begin();
  return scene.component->offer_start(InitialPoseSource::kHandover, rough_offer(checked_parameters(), test::uneven_scene().at_zero, {}, 0));
}

TEST(ComponentSearch, ARightStartIsToldAsUncheckedAndThenTracked) {
  VERIFIES("LASSO-MOD-184~5 LASSO-MOD-188~2");
  ComponentScene scene(checked_parameters(), test::uneven_scene());
  ASSERT_EQ(begin_with_right_start(scene), StartRefusal::kNone);
  Story story;
  story.run(scene, 40);
  story.expect(
      {{M::kStandby, E::kStart, M::kStarting}, {M::kStarting, E::kCheck, M::kVerifying}, {M::kVerifying, E::kPoseValid, M::kTracking}});
  std::size_t unchecked = 0;
  for (const PoseTelemetry& t : story.reports) {
    const bool waits = t.reason == static_cast<std::uint8_t>(PoseReason::kUnchecked);
    unchecked += waits ? 1 : 0;
    EXPECT_EQ(waits, t.mode == code(M::kVerifying)) << t.scan_id;
  }
  EXPECT_GT(unchecked, 3u);
  EXPECT_EQ(story.last().refused_starts, 0u);
}

// The scan that a check searches is of the old clock's time.
TEST(ComponentSearch, AStartThatIsCheckedIsConfirmedAnewWhenTheClockJumps) {
  VERIFIES("LASSO-MOD-188~2 LASSO-HLT-006~2");
  constexpr DurationUs kJump_us = 60'000'000;
  ComponentScene scene(checked_parameters(), test::uneven_scene());
  ASSERT_EQ(begin_with_right_start(scene), StartRefusal::kNone);
  Story story;
  story.run(scene, 5);
  ASSERT_EQ(story.last().mode, code(M::kVerifying));
  scene.sensor.scene_ahead_us = -kJump_us;
  run_shifted(scene, story, kJump_us, 40);
  story.expect({{M::kStandby, E::kStart, M::kStarting},
                {M::kStarting, E::kCheck, M::kVerifying},
                {M::kVerifying, E::kConfirmAnew, M::kStarting},
                {M::kStarting, E::kCheck, M::kVerifying},
                {M::kVerifying, E::kPoseValid, M::kTracking}});
  EXPECT_FALSE(scene.component->faults().ever().has(Fault::kModeCorrupt)) << "the copies of the mode have followed";
}

// A mode that awaits a start and scans nothing is left for the bearing, if that is what the next source needs; otherwise it stays.
TEST(ComponentSearch, AStartThatIsRefusedInLostGivesPlaceToTheSearch) {
  VERIFIES("LASSO-MOD-133~4");
  for (const bool ordered : {true, false}) {
    MissionParameters p = search_parameters();
    p.recover = 0;
    p.coast_frames = 0;
    p.start_age_max_s = 1;
    if (!ordered) p.start_fifth = static_cast<double>(InitialPoseSource::kNone);
    ComponentScene scene(p, test::uneven_scene());
    scene.begin();
    const test::BoxScene truth = test::uneven_scene();
    ASSERT_EQ(scene.component->start_tracking(truth.at_zero, truth.rates, 0), Status::kOk);
    ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kNavigation, rough_offer(p, truth.at_zero, truth.rates, 0)),
              StartRefusal::kNone);
    Story story;
    story.run(scene, 8);
    story.changes.clear();
    scene.sensor.hidden = true;
    story.run(scene, 6);
    std::vector<ModeChange> expected{{M::kTracking, E::kExhausted, M::kLost}};
    if (ordered) expected.push_back({M::kLost, E::kSeek, M::kBearing});
    story.expect(expected);
    EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kNavigation));
    EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kTooOld));
  }
}

TEST(ComponentSearch, ALostTargetIsLookedForNearItsPredictionThenSearched) {
  VERIFIES("LASSO-MOD-142~2");
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

// A box looks alike from several sides: never a guess, and the candidates are reported.
TEST(ComponentSearch, AnAmbiguousTargetIsNeverTracked) {
  VERIFIES("LASSO-MOD-124~1 LASSO-MOD-120~2 LASSO-MOD-136~4");
  MissionParameters p = story_parameters();
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

TEST(ComponentSearch, ASearchThatIsAlwaysLateEnds) {
  VERIFIES("LASSO-MOD-136~4 LASSO-EXE-003~1");
  MissionParameters p = story_parameters();
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

TEST(ComponentSearch, ASearchTrustsNoOldBearing) {
  VERIFIES("LASSO-MOD-136~4");
  MissionParameters p = story_parameters();
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

TEST(ComponentSearch, APoseThatWasFoundTooLateIsRefusedByItsName) {
  VERIFIES("LASSO-MOD-134~3");
  MissionParameters p = search_parameters();
  p.start_age_max_s = 0;
  p.search_slice = 100000;                                                       // several frames' work
  p.search_slice = std::floor(p.search_slice * p.search_slice / frame_work(p));  // in either number type
  p.initial_angular_rate_radps = 1e-3 * kRadPerDeg;                              // a single scan is enough
  ComponentScene scene(p, test::uneven_scene());
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  Story story;
  story.run(scene, 20);
  EXPECT_EQ(story.last().mode, code(M::kSearching));
  EXPECT_GE(story.last().refused_starts, 1u);
  EXPECT_EQ(story.last().refused_source, static_cast<std::uint8_t>(InitialPoseSource::kSearch));
  EXPECT_EQ(story.last().refusal, static_cast<std::uint8_t>(StartRefusal::kTooOld));
}

}  // namespace
}  // namespace lasso
