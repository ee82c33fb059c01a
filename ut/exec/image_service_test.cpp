#include "fsw/exec/image_trial.hpp"
#include "ut/exec/memory_scene.hpp"

namespace lasso {
namespace {

using test::all_valid;
using test::better_image;
using test::crc_of;
using test::first_image;
using test::image_of;
using test::MemoryScene;
using test::TestImage;

// It says that it is the same target, but no scan agrees with it.
const TestImage& wrong_image() {
  static const TestImage image = [] {
    test::BoxModel box;
    box.half = Vec3(0.05, 0.05, 0.9);
    box.center = Vec3(0.5, 0.5, 0);
    return image_of(MemoryScene::parameters(), {box});
  }();
  return image;
}
using ImageServiceTest = test::MemoryFixture;

TEST_F(ImageServiceTest, ABoardGivesItsMemoryBeforeTheFirstImage) {
  VERIFIES("LASSO-IMG-011~1");
  BoardMemory odd;
  odd.image_buffers[0] = scene_->buffer(0);
  EXPECT_EQ(component().use_memory(odd), Status::kBadValue);
  BoardMemory much;
  much.code = ConstBytes(scene_->code.data(), std::size_t{1} << 30);
  EXPECT_EQ(component().use_memory(much), Status::kOverCapacity);
  EXPECT_EQ(component().use_memory(BoardMemory{}), Status::kOk);
  scene_->restart();
  EXPECT_EQ(component().begin(0), Status::kMissing);
  scene_->begin(first_image());
  EXPECT_EQ(component().use_memory(BoardMemory{}), Status::kBadOrder);
  EXPECT_EQ(component().load_stored_image().status, Status::kBadOrder);
}

// At a boundary, by its CRC; the track goes on, one scan is not reported.
TEST_F(ImageServiceTest, ANewImageTakesOverAtABoundary) {
  VERIFIES("LASSO-IMG-011~1 LASSO-IMG-013~1");
  scene_->begin(first_image());
  EXPECT_TRUE(all_valid(scene_->run_frames(10)));
  EXPECT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNotReady);
  scene_->upload(better_image());
  scene_->run_frames(1);
  EXPECT_TRUE(scene_->told(EventId::kImageReady));
  EXPECT_EQ(component().activate_image(1), ImageRefusal::kOtherImage);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  scene_->run_frames(1);
  EXPECT_EQ(component().mission().image_crc, crc_of(better_image()));
  const test::Event told = scene_->last(EventId::kImageActive);
  EXPECT_EQ(told.items[4], 0) << "not rolled back";
  EXPECT_EQ(told.items[5], 1) << "the track is kept";
  const std::vector<PoseTelemetry> poses = scene_->run_frames(12);
  EXPECT_GE(poses.size(), 11U);
  EXPECT_TRUE(all_valid(poses));
  for (const PoseTelemetry& pose : poses) EXPECT_EQ(pose.image_crc, crc_of(better_image()));
  EXPECT_TRUE(scene_->told(EventId::kImageConfirmed));
}

TEST_F(ImageServiceTest, TheImageBeforeIsActiveAgainByCommand) {
  VERIFIES("LASSO-IMG-014~2");
  scene_->begin(first_image());
  scene_->run_frames(6);
  EXPECT_EQ(component().roll_back_image(), ImageRefusal::kNotReady);
  scene_->upload(better_image());
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  scene_->run_frames(20);
  ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
  scene_->run_frames(1);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  const std::vector<PoseTelemetry> poses = scene_->run_frames(10);
  EXPECT_GE(poses.size(), 9U);
  EXPECT_TRUE(all_valid(poses));
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[4], 1);
  scene_->restart();  // it is what the next start begins with
  ASSERT_EQ(component().load_stored_image().status, Status::kOk);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
}

TEST(ImageTrial, AStartThatIsCheckedSaysNothingOfTheImage) {
  VERIFIES("LASSO-MOD-184~5");
  ImageTrial trial;
  trial.begin(2, 1);
  Registration registration;
  for (const PoseReason reason : {PoseReason::kUnchecked, PoseReason::kUnchecked, PoseReason::kContradicted}) {
    registration.reason = reason;
    trial.note(registration, TrackingMode::kVerifying);
    EXPECT_EQ(trial.verdict(), TrialVerdict::kOpen);
  }
  registration.reason = PoseReason::kValid;
  trial.note(registration, TrackingMode::kVerifying);
  EXPECT_EQ(trial.verdict(), TrialVerdict::kPassed);
}

TEST(ImageTrial, SoManyScansHaveToGiveSoManyValidPoses) {
  VERIFIES("LASSO-IMG-014~2");
  for (const bool third : {false, true}) {
    ImageTrial trial;
    trial.begin(10, 3);
    Registration registration;
    for (std::uint32_t scan = 1; scan < 10; ++scan) {
      registration.reason = scan <= 2 ? PoseReason::kValid : PoseReason::kModelMismatch;
      trial.note(registration, TrackingMode::kTracking);
      EXPECT_EQ(trial.verdict(), TrialVerdict::kOpen) << scan;
      registration.reason = PoseReason::kNoScan;  // says nothing of the image
      trial.note(registration, TrackingMode::kTracking);
    }
    registration.reason = third ? PoseReason::kValid : PoseReason::kModelMismatch;
    trial.note(registration, TrackingMode::kTracking);
    EXPECT_EQ(trial.verdict(), third ? TrialVerdict::kPassed : TrialVerdict::kFailed);
  }
}

// By itself, within the scans of the trial; the track is that of before.
TEST_F(ImageServiceTest, AnImageThatFailsItsFirstScansIsTakenBack) {
  VERIFIES("LASSO-IMG-014~2");
  scene_->begin(first_image());
  scene_->run_frames(10);
  scene_->upload(wrong_image());
  ASSERT_EQ(component().activate_image(crc_of(wrong_image())), ImageRefusal::kNone);
  scene_->run_frames(1);
  EXPECT_EQ(component().mission().image_crc, crc_of(wrong_image()));
  std::uint32_t frames = 0;
  for (; frames < 30 && component().mission().image_crc != crc_of(first_image()); ++frames) {
    for (const test::Report& report : scene_->run_frame()) EXPECT_EQ(report.pose.valid, 0);
  }
  EXPECT_LE(frames, 6U + 3U);
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[4], 1);
  EXPECT_FALSE(scene_->told(EventId::kImageConfirmed));
  const std::vector<PoseTelemetry> poses = scene_->run_frames(15);
  EXPECT_GE(poses.size(), 13U);
  EXPECT_TRUE(all_valid(poses));
  EXPECT_EQ(component().activate_image(crc_of(wrong_image())), ImageRefusal::kNone) << "it may be tried again";
  scene_->restart();
  ASSERT_EQ(component().load_stored_image().status, Status::kOk);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
}

// The track is given up before the trial has its scans: it has failed all the same.
TEST_F(ImageServiceTest, AnImageThatLosesTheTrackDuringItsTrialIsTakenBack) {
  VERIFIES("LASSO-IMG-014~2");
  for (const bool recover : {false, true}) {
    scene_ = std::make_unique<MemoryScene>();
    MissionParameters hasty = MemoryScene::parameters();
    hasty.image_trial_scans = 60;
    hasty.coast_frames = 1;
    hasty.reacquire_frames = 1;
    hasty.recover = recover ? 1 : 0;
    const TestImage good = image_of(hasty);
    test::BoxModel box;
    box.half = Vec3(0.05, 0.05, 0.9);
    box.center = Vec3(0.5, 0.5, 0);
    const TestImage wrong = image_of(hasty, {box});
    scene_->begin(good);
    scene_->run_frames(10);
    scene_->upload(wrong);
    ASSERT_EQ(component().activate_image(crc_of(wrong)), ImageRefusal::kNone);
    scene_->run_frames(25);
    EXPECT_EQ(component().mission().image_crc, crc_of(good)) << recover;
    EXPECT_NE(component().open_image(100000, 7), ImageRefusal::kBusy) << "there is a way on";
  }
}

// Standby is commanded during the trial: taking the image back does not bring the old track back.
TEST_F(ImageServiceTest, ARollBackUndoesNoCommand) {
  VERIFIES("LASSO-IMG-014~2 LASSO-HLT-002~1");
  for (const TrackingMode mode : {TrackingMode::kStandby, TrackingMode::kSafe}) {
    scene_ = std::make_unique<MemoryScene>();
    scene_->begin(first_image());
    scene_->run_frames(10);
    scene_->upload(wrong_image());
    ASSERT_EQ(component().activate_image(crc_of(wrong_image())), ImageRefusal::kNone);
    scene_->run_frames(2);
    ASSERT_EQ(component().command_mode(mode), ModeRefusal::kNone);
    scene_->run_frames(1);
    ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
    scene_->run_frames(2);
    EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
    const int starts = scene_->sensor.starts;
    scene_->run_frames(3);
    EXPECT_EQ(scene_->sensor.starts, starts) << "no scan that nobody asked for";
  }
}

TEST_F(ImageServiceTest, WithoutATrialAnImageIsTrusted) {
  VERIFIES("LASSO-IMG-014~2");
  MissionParameters trusting = MemoryScene::parameters();
  trusting.image_trial_scans = 0;
  scene_->begin(image_of(trusting));
  scene_->run_frames(5);
  scene_->upload(wrong_image());
  ASSERT_EQ(component().activate_image(crc_of(wrong_image())), ImageRefusal::kNone);
  scene_->run_frames(30);
  EXPECT_EQ(component().mission().image_crc, crc_of(wrong_image()));
  EXPECT_TRUE(component().images().confirmed());
}

// An image of another target: nothing that was known of the old one serves.
TEST_F(ImageServiceTest, ATrackEndsWithItsTarget) {
  VERIFIES("LASSO-IMG-013~1");
  scene_->begin(first_image());
  scene_->run_frames(10);
  const TestImage other = test::of_mission(better_image(), 99);
  scene_->upload(other);
  ASSERT_EQ(component().activate_image(crc_of(other)), ImageRefusal::kNone);
  EXPECT_LE(scene_->run_frames(6).size(), 2U);
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[5], 0);
  EXPECT_EQ(scene_->last(EventId::kModeChanged).items[2], static_cast<std::uint8_t>(TrackingMode::kStandby));
  EXPECT_EQ(component().command_mode(TrackingMode::kReacquiring), ModeRefusal::kNoPrediction);
  // Back, in standby, where there is no track to leave.
  ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
}

// A search works with the active image's tables.
TEST_F(ImageServiceTest, ASearchEndsWithItsImage) {
  VERIFIES("LASSO-IMG-013~1");
  MissionParameters p = MemoryScene::parameters();
  p.initial_present = 0;
  scene_->begin(image_of(p));
  scene_->upload(better_image());
  ASSERT_EQ(component().command_mode(TrackingMode::kBearing), ModeRefusal::kNone);
  scene_->run_frames(6);
  ASSERT_EQ(component().command_mode(TrackingMode::kSearching), ModeRefusal::kNone);
  scene_->run_frames(1);
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[5], 0);
  EXPECT_EQ(scene_->last(EventId::kModeChanged).items[2], static_cast<std::uint8_t>(TrackingMode::kStandby));
}

// An estimate that overruns still reads the image: the change waits for it.
TEST_F(ImageServiceTest, AnEstimateUnderWayKeepsItsImage) {
  VERIFIES("LASSO-IMG-011~1 LASSO-IMG-013~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  scene_->upload(better_image());
  scene_->run_frame(false);
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  scene_->run_frame(false);
  scene_->run_frame(false);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  scene_->run_frames(2);
  EXPECT_EQ(component().mission().image_crc, crc_of(better_image()));
}

// What was commanded holds for the image that was named then, not for the one that has been loaded over it meanwhile.
TEST_F(ImageServiceTest, AnotherImageThanTheOneThatWasNamedStaysOut) {
  VERIFIES("LASSO-IMG-013~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  scene_->upload(better_image());
  scene_->run_frame(false);
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  const TestImage other = test::of_mission(better_image(), 77);
  scene_->upload(other, false);
  ASSERT_EQ(component().images().other().view(0).mission.image_crc, crc_of(other)) << "ready";
  scene_->run_frames(3);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  ASSERT_EQ(component().activate_image(crc_of(other)), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(component().mission().image_crc, crc_of(other));
}

// What was ready when the command came may have decayed at the boundary.
TEST_F(ImageServiceTest, AnImageThatIsNotReadyAtTheBoundaryStaysOut) {
  VERIFIES("LASSO-IMG-013~1");
  scene_->begin(first_image());
  scene_->run_frames(3);
  scene_->upload(better_image());
  scene_->store.broken = true;
  scene_->buffer(1)[3000] ^= 1;
  for (int i = 0; i < 60 && !component().images().found(); ++i) {
    ASSERT_FALSE(scene_->told(EventId::kMemoryCorrupt));
    component().run_slot(component().next_slot_us());
    component().run_estimation();
  }
  while (!component().images().found()) {
    component().run_slot(component().next_slot_us());
    component().run_estimation();
  }
  ASSERT_EQ(component().activate_image(crc_of(better_image())), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
  EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[5], 0) << "not repaired";
}

TEST_F(ImageServiceTest, ARefusedImageIsTold) {
  VERIFIES("LASSO-IMG-013~1 LASSO-SYS-011~2");
  scene_->begin(first_image());
  TestImage spoiled = better_image();
  spoiled.data()[5000] ^= 1;
  ASSERT_EQ(component().open_image(static_cast<std::uint32_t>(spoiled.size), crc_of(spoiled)), ImageRefusal::kNone);
  ASSERT_EQ(component().put_image(0, ConstBytes(spoiled.data(), spoiled.size)), ImageRefusal::kNone);
  ASSERT_EQ(component().check_image(), ImageRefusal::kNone);
  EXPECT_TRUE(all_valid(scene_->run_frames(40))) << "the track goes on";
  EXPECT_EQ(scene_->last(EventId::kImageRefused).items[0], static_cast<std::uint8_t>(Status::kBadCrc));
  EXPECT_EQ(component().mission().image_crc, crc_of(first_image()));
}

// The image before decays while the new one is on trial: there is nothing to go back to, and yet a way on.
TEST_F(ImageServiceTest, ATrialThatFailsWithNothingToGoBackToLeavesAWayOn) {
  VERIFIES("LASSO-IMG-014~2");
  MissionParameters patient = MemoryScene::parameters();
  patient.image_trial_scans = 60;
  patient.image_trial_valid_min = 50;
  patient.coast_frames = 200;
  const TestImage good = image_of(patient);
  test::BoxModel box;
  box.half = Vec3(0.05, 0.05, 0.9);
  box.center = Vec3(0.5, 0.5, 0);
  const TestImage wrong = image_of(patient, {box});
  scene_->begin(good);
  scene_->run_frames(10);
  scene_->upload(wrong);
  ASSERT_EQ(component().activate_image(crc_of(wrong)), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(component().open_image(100000, 7), ImageRefusal::kBusy) << "it may be wanted back";
  scene_->store.broken = true;
  scene_->buffer(0)[2000] ^= 4;
  scene_->run_frames(80);
  EXPECT_EQ(component().mission().image_crc, crc_of(wrong));
  EXPECT_NE(component().open_image(100000, 7), ImageRefusal::kBusy);
}

TEST_F(ImageServiceTest, AnImageOfAnotherTargetDoesNotEndModeSafe) {
  VERIFIES("LASSO-HLT-002~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  ASSERT_EQ(component().command_mode(TrackingMode::kSafe), ModeRefusal::kNone);
  const TestImage other = test::of_mission(better_image(), 99);
  scene_->upload(other);
  ASSERT_EQ(component().activate_image(crc_of(other)), ImageRefusal::kNone);
  EXPECT_EQ(scene_->run_frames(3).back().mode, static_cast<std::uint8_t>(TrackingMode::kSafe)) << "as it was";
  EXPECT_EQ(component().mission().image_crc, crc_of(other));
}

}  // namespace
}  // namespace lasso
