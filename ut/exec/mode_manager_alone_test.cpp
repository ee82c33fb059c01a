// The track from boundary to boundary, without a component around it: what scans led to is said by hand.
#include "fsw/exec/mode_manager.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/box_sensors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

constexpr SensorNumber kFirst = 0, kSecond = 1;

class ModeManagerAlone : public ::testing::Test {
 protected:
  static MissionParameters parameters() {
    MissionParameters p = test::box_parameters(test::default_scene());
    p.initial_present = 0;
    p.recover = 1;
    p.common_memory_s = 100;
    return p;
  }
  void SetUp() override {
    test::BoxTables tables = test::make_box_tables(test::BoxModel{});
    test::append_sensor(test::sensor_of(parameters(), 0, 3), tables[test::kSensorsTable]);
    image = test::make_image(parameters(), tables);
    ASSERT_EQ(images.start(Bytes(image.data(), image.size), acquisition.sensors()).status, Status::kOk);
    ASSERT_EQ(executive.begin(0, 200'000), Status::kOk);
  }
  SensorBank both() {
    SensorBank bank = only(first);
    EXPECT_TRUE(bank.push_back(&second));
    return bank;
  }

  StartRefusal offer(InitialPoseSource source) {
    return modes.offer_start(source, rough_offer(parameters(), test::default_scene().at_zero, Twist{}, 0));
  }
  void follow(E event, M mode) {
    TrackStep step;
    step.after = modes.track();
    step.after.mode = mode;
    step.event = event;
    step.registration.t_us = step.after.filter.t_us;
    modes.follow(step);
    ASSERT_EQ(modes.mode(), mode);
  }
  // A track of the first sensor, whose filter has errors in common with its scans.
  void track() {
    ASSERT_EQ(offer(InitialPoseSource::kUplink), StartRefusal::kNone);
    modes.apply_request();
    TrackStep step;
    step.after = modes.track();
    step.after.mode = M::kTracking;
    step.after.filter.common_pose.setConstant(1e-4);
    step.event = E::kPoseValid;
    modes.follow(step);
    ASSERT_EQ(modes.mode(), M::kTracking);
  }
  // A start that a scan has confirmed, and that is checked.
  void verify() {
    ASSERT_EQ(offer(InitialPoseSource::kUplink), StartRefusal::kNone);
    modes.apply_request();
    follow(E::kCheck, M::kVerifying);
    modes.keep_mode();
    PoseTelemetry told;
    modes.report(told);
  }
  // What the next packet says of changes.
  std::vector<std::pair<M, M>> changes() {
    PoseTelemetry told;
    modes.report(told);
    std::vector<std::pair<M, M>> all;
    for (std::size_t i = 0; i < told.changes; ++i) all.emplace_back(static_cast<M>(told.change_from[i]), static_cast<M>(told.change_to[i]));
    return all;
  }
  double common_errors() const { return modes.track().filter.common_pose.norm(); }
  // The items of the refusals of starts that were reported: source and refusal.
  std::vector<std::pair<InitialPoseSource, StartRefusal>> refusals() const {
    std::vector<std::pair<InitialPoseSource, StartRefusal>> all;
    for (const EventRecord& event : events.records()) {
      if (event.id != EventId::kStartRefused) continue;
      all.emplace_back(static_cast<InitialPoseSource>(event.items[0]), static_cast<StartRefusal>(event.items[1]));
    }
    return all;
  }

  test::TestImage image;
  test::BoxSensor first{test::default_scene()}, second{test::default_scene()};
  AcquisitionTask acquisition{both()};
  Executive executive;
  ImageKeeper images;
  Telemetry telemetry{kApid};
  EventLog& events = telemetry.events();
  HealthMonitor health{executive, telemetry};
  Interlocks interlocks{acquisition, telemetry};
  ScanScheduler scans{acquisition, executive, images, telemetry, health};
  const ComponentContext context{executive, images, telemetry, health, interlocks, scans};
  ModeManager modes{context};
};

const std::vector<std::pair<InitialPoseSource, StartRefusal>> kOneTooOld{{InitialPoseSource::kUplink, StartRefusal::kTooOld}};

TEST_F(ModeManagerAlone, AStartThatAJumpOvertakesIsRefused) {
  VERIFIES("LASSO-MOD-134~3 LASSO-HLT-006~2");
  ASSERT_EQ(offer(InitialPoseSource::kUplink), StartRefusal::kNone);
  modes.follow_jump(-20'000'000);
  modes.apply_request();
  EXPECT_EQ(modes.mode(), M::kStandby);
  EXPECT_EQ(refusals(), kOneTooOld);
}

TEST_F(ModeManagerAlone, AStartOfTheTargetBeforeIsRefused) {
  VERIFIES("LASSO-MOD-134~3 LASSO-IMG-013~1");
  ASSERT_EQ(offer(InitialPoseSource::kUplink), StartRefusal::kNone);
  modes.take_over_track(false, true);
  modes.apply_request();
  EXPECT_EQ(modes.mode(), M::kStandby);
  EXPECT_EQ(refusals(), kOneTooOld);
}

TEST_F(ModeManagerAlone, ASearchBeginsAnewWhenTheClockJumps) {
  VERIFIES("LASSO-HLT-006~2");
  for (const M mode : {M::kBearing, M::kSearching}) {
    ASSERT_EQ(modes.command_mode(mode), ModeRefusal::kNone);
    modes.apply_request();
    ASSERT_EQ(modes.mode(), mode);
    modes.keep_mode();
    const std::uint32_t searches = modes.track().searches;
    modes.follow_jump(60'000'000);
    EXPECT_EQ(modes.track().searches, mode == M::kSearching ? searches + 1 : searches);
  }
}

const std::vector<std::pair<M, M>> kBack{{M::kVerifying, M::kStarting}};

TEST_F(ModeManagerAlone, ACheckedStartIsConfirmedAnewWhenTheClockJumps) {
  VERIFIES("LASSO-MOD-188~2 LASSO-HLT-006~2");
  verify();
  for (int jump = 0; jump < 2; ++jump) modes.follow_jump(60'000'000);
  EXPECT_EQ(modes.mode(), M::kStarting);
  EXPECT_EQ(changes(), kBack) << "once";
  modes.check_mode();
  EXPECT_EQ(modes.mode(), M::kStarting) << "the copies have followed";
  EXPECT_TRUE(refusals().empty()) << "the start goes on";
}

TEST_F(ModeManagerAlone, ACheckedStartIsConfirmedAnewWithAnotherImageOfItsTarget) {
  VERIFIES("LASSO-MOD-188~2 LASSO-IMG-013~1");
  verify();
  modes.take_over_track(true, true);
  EXPECT_EQ(modes.mode(), M::kStarting);
  EXPECT_EQ(changes(), kBack);
  follow(E::kCheck, M::kVerifying);
  EXPECT_EQ(changes().size(), 1u);
  modes.take_over_track(false, true);
  EXPECT_EQ(modes.mode(), M::kStandby);
  EXPECT_EQ(changes().size(), 1u) << "and ends with its target";
}

TEST_F(ModeManagerAlone, ACheckedStartIsRefusedWhereItIsGivenUpAlone) {
  VERIFIES("LASSO-MOD-188~2 LASSO-MOD-134~3");
  verify();
  follow(E::kPoseInvalid, M::kVerifying);
  follow(E::kConfirmAnew, M::kStarting);
  follow(E::kCheck, M::kVerifying);
  EXPECT_TRUE(refusals().empty());
  follow(E::kExhausted, M::kLost);
  const std::vector<std::pair<InitialPoseSource, StartRefusal>> one{{InitialPoseSource::kUplink, StartRefusal::kNotConfirmed}};
  EXPECT_EQ(refusals(), one);
}

// The errors of one sensor are not those of another one: the track that is taken up again knows that, too.
TEST_F(ModeManagerAlone, AnInterruptedTrackHasNoErrorsInCommonWithAnotherSensor) {
  VERIFIES("LASSO-SNS-046~1 LASSO-MOD-185~1");
  for (const SensorNumber sensor : {kFirst, kSecond}) {
    track();
    ASSERT_EQ(offer(InitialPoseSource::kHandover), StartRefusal::kNone);
    modes.apply_request();
    ASSERT_TRUE(modes.track().interrupts);
    modes.use_sensor(sensor);
    follow(E::kFallBack, M::kReacquiring);
    EXPECT_EQ(common_errors() > 0, sensor == kFirst);
    EXPECT_EQ(modes.track().sensor, sensor);
  }
}

TEST_F(ModeManagerAlone, ATrackThatIsRestoredHasNoErrorsInCommonWithAnotherSensor) {
  VERIFIES("LASSO-SNS-046~1 LASSO-IMG-014~2");
  track();
  modes.take_over_track(true, true);
  modes.use_sensor(kSecond);
  ASSERT_EQ(common_errors(), 0);
  modes.restore_track();
  ASSERT_GT(common_errors(), 0) << "of the first sensor";
  modes.use_sensor(kSecond);
  EXPECT_EQ(common_errors(), 0);
}

// In bearing there is no attitude: the remembered one is none of it.
TEST_F(ModeManagerAlone, ABearingStaysWithoutAPoseWhenAnImageIsTakenBack) {
  VERIFIES("LASSO-IMG-014~2");
  for (const bool bearing : {false, true}) {
    track();
    modes.take_over_track(true, true);
    follow(E::kRecover, M::kReacquiring);
    if (bearing) {
      TrackStep step;
      step.after = modes.track();
      change_mode(E::kRecover, step.after);
      step.event = E::kRecover;
      modes.follow(step);
      ASSERT_EQ(modes.mode(), M::kBearing);
    }
    ASSERT_TRUE(modes.remembers_track());
    modes.restore_track();
    EXPECT_EQ(modes.track().filter.initialised, !bearing);
  }
}

}  // namespace
}  // namespace lasso
