// Faults that happen to the whole component, and how it answers.
#include <algorithm>
#include <cstring>
#include <limits>

#include "ut/exec/mode_story.hpp"

namespace lasso {
namespace {

using test::code;
using test::ComponentScene;
using test::run_shifted;
using test::Story;
using M = TrackingMode;
using E = ModeEvent;

// Before a box that is there and tracked, with nothing wrong.
class TrackedComponent : public ::testing::Test {
 protected:
  void fly(int frames) {
    scene.begin();
    story.run(scene, frames);
  }
  ComponentScene scene{test::box_parameters(test::default_scene())};
  Story story;
};

// Where in the component's memory the mode lies in its copies: the one place with a word, its inverse and the word again.
std::uint32_t* copies_of_mode(Component& component, TrackingMode mode) {
  const auto word = static_cast<std::uint32_t>(mode);
  auto* words = reinterpret_cast<std::uint32_t*>(&component);
  std::uint32_t* found = nullptr;
  for (std::size_t i = 0; i + 2 < sizeof(Component) / sizeof(std::uint32_t); ++i) {
    if (words[i] != word || words[i + 1] != ~word || words[i + 2] != word) continue;
    EXPECT_EQ(found, nullptr) << "one such place";
    found = words + i;
  }
  EXPECT_NE(found, nullptr);
  return found;
}

TEST_F(TrackedComponent, AnUndisturbedFlightHasNoFault) {
  VERIFIES("LASSO-HLT-001~1");
  fly(30);
  EXPECT_EQ(scene.component->faults().confirmations(), 0u);
  EXPECT_EQ(story.last().mode, code(M::kTracking));
}

TEST_F(TrackedComponent, SafeIsCommandedTakesNoStartAndIsLeftByCommand) {
  VERIFIES("LASSO-HLT-002~1");
  fly(8);
  const PoseTelemetry trusted = story.last();
  ASSERT_EQ(trusted.mode, code(M::kTracking));
  scene.sensor.laser_permitted = true;
  ASSERT_EQ(scene.component->command_mode(M::kSafe), ModeRefusal::kNone);
  const test::BoxScene truth = test::default_scene();
  EXPECT_EQ(scene.component->start_tracking(truth.pose_at(0), truth.rates, 0), Status::kBadValue) << "nothing takes the place of safe";
  EXPECT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNotFromHere);
  story.run(scene, 6);
  story.expect(
      {{M::kStandby, E::kStart, M::kStarting}, {M::kStarting, E::kPoseValid, M::kTracking}, {M::kTracking, E::kMakeSafe, M::kSafe}});
  const PoseTelemetry& t = story.last();
  EXPECT_EQ(t.mode, code(M::kSafe));
  EXPECT_EQ(t.valid, 0);
  EXPECT_EQ(t.reason, static_cast<std::uint8_t>(PoseReason::kNoTrack));
  EXPECT_GE(t.t_measurement_us, trusted.t_measurement_us) << "the last trusted state, with its own time";
  EXPECT_LT(scene.error(t).norm(), 1e-2);
  const int started = scene.sensor.starts;
  story.run(scene, 5);
  EXPECT_EQ(scene.sensor.starts, started) << "no scans";
  EXPECT_FALSE(scene.sensor.laser_permitted);
  EXPECT_EQ(scene.component->offer_start(InitialPoseSource::kUplink,
                                         rough_offer(scene.component->mission().parameters, truth.pose_at(0), truth.rates, 0)),
            StartRefusal::kNotFromHere);
  EXPECT_EQ(scene.component->command_mode(M::kSearching), ModeRefusal::kNotFromHere);
  ASSERT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone);
  story.run(scene, 3);
  EXPECT_EQ(story.changes.back().to, M::kStandby);
}

// What a later command of the same frame displaced does not come when a start is awaited next.
TEST(HealthMonitor, AStartThatIsDisplacedStaysAway) {
  VERIFIES("LASSO-HLT-002~1");
  ComponentScene scene(test::story_parameters());
  scene.begin();
  Story story;
  story.run(scene, 2);
  const test::BoxScene truth = test::default_scene();
  const TimeUs now_us = scene.component->next_slot_us();
  ASSERT_EQ(scene.component->start_tracking(truth.pose_at(now_us), truth.rates, now_us), Status::kOk);
  ASSERT_EQ(scene.component->command_mode(M::kSafe), ModeRefusal::kNone);
  story.run(scene, 2);
  ASSERT_EQ(scene.component->command_mode(M::kStandby), ModeRefusal::kNone);
  story.run(scene, 2);
  ASSERT_EQ(scene.component->command_mode(M::kBearing), ModeRefusal::kNone);
  story.run(scene, 6);
  EXPECT_EQ(story.last().mode, code(M::kBearing));
}

TEST_F(TrackedComponent, AFlippedBitOfTheModeIsOutvotedToldAndRepaired) {
  VERIFIES("LASSO-HLT-004~1");
  fly(6);
  std::uint32_t* const copies = copies_of_mode(*scene.component, M::kTracking);
  std::uint32_t told = 0;
  for (std::size_t bit = 0; bit < 96; bit += 5) {
    copies[bit / 32] ^= 1u << bit % 32;
    story.run(scene, 1);
    EXPECT_TRUE(scene.component->faults().active().has(Fault::kModeCorrupt)) << bit;
    EXPECT_EQ(scene.component->faults().confirmations(), ++told);
    EXPECT_EQ(copies[0], static_cast<std::uint32_t>(M::kTracking));
    EXPECT_EQ(copies[1], ~copies[0]);
    EXPECT_EQ(copies[2], copies[0]);
    story.run(scene, 1);
    EXPECT_FALSE(scene.component->faults().active().has(Fault::kModeCorrupt)) << "repaired";
    EXPECT_EQ(story.last().mode, code(M::kTracking));
    EXPECT_EQ(story.last().valid, 1);
  }
}

TEST_F(TrackedComponent, CopiesThatAgreeOnAnotherModeAreBelieved) {
  VERIFIES("LASSO-HLT-004~1");
  fly(6);
  std::uint32_t* const copies = copies_of_mode(*scene.component, M::kTracking);
  copies[0] = copies[2] = static_cast<std::uint32_t>(M::kCoasting);
  copies[1] = ~copies[0];
  story.run(scene, 2);
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kModeCorrupt));
  EXPECT_EQ(story.changes.back().from, M::kCoasting);
  EXPECT_EQ(story.last().mode, code(M::kTracking)) << "the next pose takes the track up again";
}

TEST_F(TrackedComponent, MirrorsThatStandStillLoseTheScan) {
  VERIFIES("LASSO-HLT-001~1");
  fly(6);
  scene.sensor.stuck = true;
  story.run(scene, 4);
  EXPECT_TRUE(scene.component->faults().active().has(Fault::kSensorStuck));
  EXPECT_EQ(story.last().valid, 0);
  EXPECT_EQ(story.last().reason, static_cast<std::uint8_t>(PoseReason::kNoScan));
  scene.sensor.stuck = false;
  story.run(scene, 8);
  EXPECT_EQ(story.last().valid, 1);
  EXPECT_FALSE(scene.component->faults().active().has(Fault::kSensorStuck));
}

// The target is elsewhere from one scan to the next: the filter excludes it, until it is itself what cannot be believed.
TEST(HealthMonitor, AFilterThatExcludesScanAfterScanIsStartedAnew) {
  VERIFIES("LASSO-FLT-011~2 LASSO-HLT-001~1");
  MissionParameters p = test::box_parameters(test::default_scene());
  p.coast_frames = 20;
  ComponentScene scene(p);
  scene.begin();
  Story story;
  story.run(scene, 12);
  scene.sensor.scene_ahead_us = 1'000'000;
  story.run(scene, 12);
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kImplausiblePose));
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kFilterDivergence));
  const auto again = std::find_if(story.changes.begin(), story.changes.end(), [](const ModeChange& c) { return c.event == E::kReacquire; });
  EXPECT_NE(again, story.changes.end());
  EXPECT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.last().valid, 1);
}

// Where a filter's pose lies in the component's memory, in each of its copies.
std::vector<double*> copies_of_place(Component& component, const double (&p_m)[3]) {
  auto* doubles = reinterpret_cast<double*>(&component);
  std::vector<double*> found;
  for (std::size_t i = 0; i + 2 < sizeof(Component) / sizeof(double); ++i) {
    if (std::memcmp(doubles + i, p_m, sizeof(p_m)) == 0) found.push_back(doubles + i);
  }
  return found;
}

TEST(HealthMonitor, AFilterWithoutNumbersIsLeftForABearing) {
  VERIFIES("LASSO-FLT-011~2 LASSO-HLT-001~1");
  MissionParameters p = test::box_parameters(test::default_scene());
  p.coast_frames = 20;
  ComponentScene scene(p);
  scene.begin();
  Story story;
  story.run(scene, 10);
  scene.component->run_slot(scene.component->next_slot_us());  // a boundary: what is reported now is what the next estimate begins from
  std::vector<std::uint8_t> bytes(kTelemetryQueueBytes);
  bytes.resize(scene.component->take_telemetry(Bytes(bytes.data(), bytes.size())));
  const auto told = test::decode_all(ConstBytes(bytes.data(), bytes.size()));
  ASSERT_EQ(told.size(), 1u);
  const std::vector<double*> places = copies_of_place(*scene.component, told[0].pose.filter_p_sensor_target_m);
  ASSERT_FALSE(places.empty());
  for (double* place : places) *place = std::numeric_limits<double>::quiet_NaN();
  scene.sensor.hidden = true;  // a scan would have set it right
  scene.component->run_estimation();
  story.run(scene, 1);  // the frame's other slots
  for (int frame = 0; frame < 8; ++frame) {
    story.run(scene, 1);
    EXPECT_EQ(story.last().valid, 0) << "nothing of it is published as valid";
  }
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kFilterDivergence));
  EXPECT_EQ(story.last().mode, code(M::kBearing));
}

TEST_F(TrackedComponent, AModeThatNobodyKnowsMakesSafe) {
  VERIFIES("LASSO-HLT-002~1 LASSO-HLT-004~1");
  fly(6);
  std::uint32_t* const copies = copies_of_mode(*scene.component, M::kTracking);
  copies[0] ^= 1;
  copies[1] ^= 4;
  scene.sensor.laser_permitted = true;
  story.run(scene, 1);
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kModeLost));
  EXPECT_FALSE(scene.sensor.laser_permitted);
  EXPECT_EQ(story.last().mode, code(M::kSafe)) << "the packet of that very frame";
  copies[0] ^= 1;  // and again, before the fault is cleared
  copies[1] ^= 4;
  story.run(scene, 3);
  EXPECT_EQ(story.last().mode, code(M::kSafe));
}

class CountingWatchdog final : public Watchdog {
 public:
  void feed() override { ++fed; }
  int fed = 0;
};

TEST_F(TrackedComponent, TheWatchdogIsFedByWholeFramesAlone) {
  VERIFIES("LASSO-HLT-003~2");
  CountingWatchdog watchdog;
  scene.component->set_watchdog(watchdog);
  scene.begin();
  for (int i = 0; i < 5; ++i) scene.run_frame();
  EXPECT_EQ(watchdog.fed, 5);
  for (int i = 0; i < 20; ++i) scene.run_frame(false);
  EXPECT_LE(watchdog.fed, 5 + static_cast<int>(CheckIn::kEstimationFrames)) << "the estimation thread is dead";
  scene.run_frame();
  const int fed = watchdog.fed;
  scene.run_frame();
  EXPECT_EQ(watchdog.fed, fed + 1) << "and lives again";
}

TEST_F(TrackedComponent, AfterTheWatchdogItBeginsInSafe) {
  VERIFIES("LASSO-HLT-002~1 LASSO-HLT-009~2");
  scene.component->set_reset_cause(ResetCause::kWatchdog);
  fly(4);
  story.expect({{M::kStandby, E::kMakeSafe, M::kSafe}});
  EXPECT_TRUE(scene.component->faults().active().has(Fault::kWatchdogReset));
}

TEST(HealthMonitor, AClockThatJumpsIsFollowedAndTheTargetLookedForAgain) {
  VERIFIES("LASSO-HLT-006~2");
  for (const DurationUs jump_us : {DurationUs{3'600'000'000}, DurationUs{-40'000'000}}) {
    MissionParameters p = test::box_parameters(test::default_scene());
    p.recover = 1;
    ComponentScene scene(p);
    scene.begin();
    Story story;
    story.run(scene, 8);
    scene.sensor.scene_ahead_us = -jump_us;  // the scene goes on as if nothing had happened
    run_shifted(scene, story, jump_us, 8);
    EXPECT_TRUE(scene.component->faults().ever().has(Fault::kTimeJump)) << jump_us;
    EXPECT_EQ(story.changes[2].event, E::kReacquire);
    EXPECT_EQ(story.last().mode, code(M::kTracking)) << jump_us;
  }
}

// The track that a wrong offer interrupts is of the old clock's time, too.
TEST(HealthMonitor, AClockThatJumpsIsFollowedByAnInterruptedTrack) {
  VERIFIES("LASSO-HLT-006~2 LASSO-MOD-185~1");
  constexpr DurationUs kJump_us = 100'000'000;
  MissionParameters p = test::box_parameters(test::default_scene());
  p.recover = 1;
  p.start_frames = 6;
  ComponentScene scene(p);
  scene.begin();
  Story story;
  story.run(scene, 8);
  Pose wrong = test::default_scene().pose_at(8 * 200000);
  wrong.p.y() += 1;
  StartOffer offer = rough_offer(p, wrong, Twist{}, 8 * 200000);
  offer.covariance = 1e-4 * Mat6::Identity();
  ASSERT_EQ(scene.component->offer_start(InitialPoseSource::kHandover, offer), StartRefusal::kNone);
  story.run(scene, 2);
  scene.sensor.scene_ahead_us = -kJump_us;
  run_shifted(scene, story, kJump_us, 12);
  ASSERT_EQ(story.last().mode, code(M::kTracking));
  EXPECT_EQ(story.changes[story.changes.size() - 2].event, E::kFallBack);
  const Pose told{Quat(story.last().q_sensor_target[3], story.last().q_sensor_target[0], story.last().q_sensor_target[1],
                       story.last().q_sensor_target[2]),
                  Vec3(story.last().p_sensor_target_m[0], story.last().p_sensor_target_m[1], story.last().p_sensor_target_m[2])};
  EXPECT_LT(pose_difference(told, test::default_scene().pose_at(story.last().t_measurement_us - kJump_us)).norm(), 1e-2);
}

TEST(HealthMonitor, AJumpStartsNothingWhereNothingIsTracked) {
  VERIFIES("LASSO-HLT-006~2");
  for (const M mode : {M::kStandby, M::kBearing}) {
    ComponentScene scene(test::story_parameters());
    scene.begin();
    ASSERT_EQ(scene.component->command_mode(mode), ModeRefusal::kNone);
    Story story;
    story.run(scene, 4);
    run_shifted(scene, story, 3'600'000'000, 4);
    EXPECT_TRUE(scene.component->faults().ever().has(Fault::kTimeJump));
    EXPECT_EQ(story.changes.size(), mode == M::kStandby ? 0u : 1u) << "the mode is the commanded one";
  }
}

TEST_F(TrackedComponent, ALateSlotIsNoJump) {
  VERIFIES("LASSO-HLT-006~2");
  fly(4);
  const TimeUs slot_us = scene.component->next_slot_us();
  EXPECT_FALSE(scene.component->slot_is_due(slot_us - 1));
  scene.component->run_slot(slot_us + 30'000);
  story.run(scene, 2);
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kSlotSlip));
  const std::uint32_t confirmations = scene.component->faults().confirmations();
  for (int late = 0; late < 5; ++late) {
    story.run(scene, 20);
    scene.component->run_slot(scene.component->next_slot_us() + 30'000);
  }
  EXPECT_EQ(scene.component->faults().confirmations(), confirmations) << "a processor that is late now and then is reported once";
  EXPECT_FALSE(scene.component->faults().ever().has(Fault::kTimeJump));
}

TEST_F(TrackedComponent, OverrunsAndAFullQueueAreFaults) {
  VERIFIES("LASSO-HLT-001~1");
  fly(5);
  for (int frame = 0; frame < 40; ++frame) {
    do {
      scene.component->run_slot(scene.component->next_slot_us());
    } while (!scene.component->next_slot_is_boundary());
  }
  EXPECT_TRUE(scene.component->faults().ever().has(Fault::kEstimateOverrun));
  EXPECT_TRUE(scene.component->faults().active().has(Fault::kMemoryHigh)) << "nobody took the telemetry";
}

// A message's own count is of 16 bits (the sequence count, of 14: component_test.cpp).
TEST_F(TrackedComponent, MessageCountsWrapWithoutAGap) {
  VERIFIES("LASSO-HLT-007~2");
  scene.begin();
  ASSERT_EQ(scene.component->command_mode(M::kSafe), ModeRefusal::kNone);
  for (int i = 0; i < 4; ++i) scene.run_frame();
  std::uint32_t packets = 0;
  std::uint32_t first = 0;
  for (std::uint32_t frame = 0; frame < 66'000; ++frame) {
    for (const test::Report& report : scene.run_frame()) {
      if (packets == 0) first = report.header.message_count;
      ASSERT_EQ(report.header.message_count, (first + packets) % 65536) << frame;
      ASSERT_EQ(report.pose.mode, code(M::kSafe));
      ++packets;
    }
  }
  EXPECT_EQ(packets, 66'000u) << "each frame of mode safe says what was trusted last";
}

// CUC time begins anew after 2^32 s; what is computed with goes on.
TEST_F(TrackedComponent, TimeWrapsOnTheWireAlone) {
  VERIFIES("LASSO-HLT-007~2");
  constexpr TimeUs kWrap_us = (TimeUs{1} << 32) * 1'000'000;
  constexpr TimeUs kBegin_us = kWrap_us - 2'000'000;
  scene.sensor.scene_ahead_us = -kBegin_us;
  ASSERT_EQ(scene.load().status, Status::kOk);
  ASSERT_EQ(scene.component->begin(kBegin_us), Status::kOk);
  for (std::uint32_t frame = 0; frame < 30; ++frame) {
    for (const test::Report& report : scene.run_frame()) {
      const TimeUs published_us = kBegin_us + frame * 200'000;
      EXPECT_EQ(report.header.t_us, published_us % kWrap_us) << frame;
      EXPECT_EQ(report.pose.t_publication_us, published_us);
      EXPECT_EQ(report.pose.valid, 1) << frame;
    }
  }
  EXPECT_EQ(scene.component->faults().confirmations(), 0u);
}

}  // namespace
}  // namespace lasso
