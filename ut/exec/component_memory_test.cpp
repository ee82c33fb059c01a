#include "ut/exec/memory_scene.hpp"
#include "ut/support/box_calibrations.hpp"

namespace lasso {
namespace {

using test::crc_of;
using test::MemoryScene;
using test::TestImage;

TestImage image_of(const MissionParameters& parameters, const test::Boxes& boxes = {test::BoxModel{}}) {
  return test::make_image(parameters, test::make_box_tables(boxes));
}
const TestImage& first_image() {
  static const TestImage image = image_of(MemoryScene::parameters());
  return image;
}
// The same target, with other numbers.
const TestImage& better_image() {
  static const TestImage image = [] {
    MissionParameters p = MemoryScene::parameters();
    p.inliers_min = 50;
    return image_of(p);
  }();
  return image;
}
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
// For a camera of this serial number.
TestImage calibrated_image(std::uint32_t serial) {
  test::BoxTables tables = test::make_box_tables({test::BoxModel{}});
  test::append_calibration(0, test::bent_calibration(serial), tables[test::kCalibrationsTable]);
  return test::make_image(MemoryScene::parameters(), tables);
}
bool all_valid(const std::vector<PoseTelemetry>& poses) {
  return std::all_of(poses.begin(), poses.end(), [](const PoseTelemetry& pose) { return pose.valid != 0; });
}

class ComponentMemory : public ::testing::Test {
 protected:
  std::unique_ptr<MemoryScene> scene_ = std::make_unique<MemoryScene>();
  Component& component() { return *scene_->component; }
};

TEST_F(ComponentMemory, ABoardGivesItsMemoryBeforeTheFirstImage) {
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
TEST_F(ComponentMemory, ANewImageTakesOverAtABoundary) {
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

TEST_F(ComponentMemory, TheImageBeforeIsActiveAgainByCommand) {
  VERIFIES("LASSO-IMG-014~1");
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

// From the first scan, with a new image, and back again to what the sensor was made with.
TEST_F(ComponentMemory, SensorsAreCalibratedAsTheActiveImageSays) {
  VERIFIES("LASSO-LCS-007~2");
  scene_->sensor.serial = 99;
  scene_->begin(first_image());
  scene_->run_frames(3);
  EXPECT_EQ(scene_->sensor.serial, 0U) << "the image has none";
  const TestImage calibrated = calibrated_image(31);
  scene_->upload(calibrated);
  EXPECT_EQ(scene_->sensor.serial, 0U) << "not active yet";
  ASSERT_EQ(component().activate_image(crc_of(calibrated)), ImageRefusal::kNone);
  scene_->run_frames(20);
  EXPECT_EQ(scene_->sensor.serial, 31U);
  ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 0U);
}

TEST_F(ComponentMemory, ACalibrationComesBackWithTheStoredImage) {
  VERIFIES("LASSO-LCS-007~2");
  scene_->begin(first_image());
  scene_->run_frames(3);
  const TestImage calibrated = calibrated_image(31);
  scene_->upload(calibrated);
  ASSERT_EQ(component().activate_image(crc_of(calibrated)), ImageRefusal::kNone);
  scene_->run_frames(20);
  EXPECT_TRUE(scene_->told(EventId::kImageConfirmed));
  scene_->restart();
  scene_->sensor.serial = 0;
  ASSERT_EQ(component().load_stored_image().status, Status::kOk);
  ASSERT_EQ(component().begin(0), Status::kOk);
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 31U);
}

// A flip in a record that is in use is told and repaired; until then the sensor has what was right.
TEST_F(ComponentMemory, ACalibrationThatDecaysIsNotBelieved) {
  VERIFIES("LASSO-LCS-007~2 LASSO-LCS-015~1");
  scene_->begin(calibrated_image(31));
  scene_->run_frames(3);
  ASSERT_EQ(scene_->sensor.serial, 31U);
  test::TestImage as_sent = calibrated_image(31);
  auto* const bytes = const_cast<std::uint8_t*>(component().images().active().sealed_image().data());
  const std::size_t offset = test::table_offset(as_sent, static_cast<std::uint32_t>(TableId::kCalibrations));
  ASSERT_EQ(bytes[offset + 7], 31);
  bytes[offset + 8] = 0x7F;  // a focal length of 1e308 m
  bytes[offset + 7] = 32;
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 31U);
  bytes[offset + 8] = as_sent.data()[offset + 8];
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 32U) << "what is valid is believed until the scrub finds it";
  scene_->run_frames(60);
  EXPECT_TRUE(scene_->told(EventId::kMemoryCorrupt));
}

// Its scans are lost as another sensor's: it has failed its trial.
TEST_F(ComponentMemory, AnImageForAnotherCameraIsTakenBack) {
  VERIFIES("LASSO-IMG-014~1 LASSO-LCS-015~1");
  scene_->sensor.own_serial = 31;
  scene_->begin(calibrated_image(31));
  EXPECT_TRUE(all_valid(scene_->run_frames(10)));
  const TestImage foreign = calibrated_image(32);
  scene_->upload(foreign);
  ASSERT_EQ(component().activate_image(crc_of(foreign)), ImageRefusal::kNone);
  scene_->run_frames(12);
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[4], 1) << "rolled back";
  EXPECT_EQ(scene_->sensor.serial, 31U);
  scene_->run_frames(8);
  EXPECT_EQ(scene_->run_frames(1).back().valid, 1);
}

// By itself, within the scans of the trial; the track is that of before.
TEST_F(ComponentMemory, AnImageThatFailsItsFirstScansIsTakenBack) {
  VERIFIES("LASSO-IMG-014~1");
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
TEST_F(ComponentMemory, AnImageThatLosesTheTrackDuringItsTrialIsTakenBack) {
  VERIFIES("LASSO-IMG-014~1");
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
TEST_F(ComponentMemory, ARollBackUndoesNoCommand) {
  VERIFIES("LASSO-IMG-014~1 LASSO-HLT-002~1");
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

TEST_F(ComponentMemory, WithoutATrialAnImageIsTrusted) {
  VERIFIES("LASSO-IMG-014~1");
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
TEST_F(ComponentMemory, ATrackEndsWithItsTarget) {
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
TEST_F(ComponentMemory, ASearchEndsWithItsImage) {
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
TEST_F(ComponentMemory, AnEstimateUnderWayKeepsItsImage) {
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
TEST_F(ComponentMemory, AnotherImageThanTheOneThatWasNamedStaysOut) {
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
TEST_F(ComponentMemory, AnImageThatIsNotReadyAtTheBoundaryStaysOut) {
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

TEST_F(ComponentMemory, ARefusedImageIsTold) {
  VERIFIES("LASSO-IMG-013~1");
  scene_->begin(first_image());
  TestImage spoiled = better_image();
  spoiled.data()[5000] ^= 1;
  ASSERT_EQ(component().open_image(static_cast<std::uint32_t>(spoiled.size), crc_of(spoiled)), ImageRefusal::kNone);
  ASSERT_EQ(component().put_image(0, ConstBytes(spoiled.data(), spoiled.size)), ImageRefusal::kNone);
  ASSERT_EQ(component().check_image(), ImageRefusal::kNone);
  scene_->run_frames(40);
  EXPECT_EQ(scene_->last(EventId::kImageRefused).items[0], static_cast<std::uint8_t>(Status::kBadCrc));
}

// Flips while tracking: told within a period of the scrub, and poses go on.
TEST_F(ComponentMemory, FlipsAreToldAndRepairedWhileTracking) {
  VERIFIES("LASSO-IMG-016~1 LASSO-IMG-017~1 LASSO-HLT-010~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  const std::vector<std::uint64_t> right = scene_->buffers[0];
  for (const std::size_t byte : {std::size_t{1000}, first_image().size / 2, first_image().size - 1}) {
    scene_->events.clear();
    scene_->buffer(0)[byte] ^= 0x20;
    scene_->run_frames(50);
    EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[0], static_cast<std::uint8_t>(ScrubArea::kImage0));
    EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[5], 1) << "repaired";
    EXPECT_EQ(scene_->buffers[0], right);
  }
  scene_->events.clear();
  scene_->code[30000] ^= 1;
  scene_->run_frames(50);
  EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[0], static_cast<std::uint8_t>(ScrubArea::kCode));
  EXPECT_EQ(scene_->last(EventId::kMemoryCorrupt).items[5], 0);
  EXPECT_TRUE(all_valid(scene_->run_frames(5)));
}

// Without the store nothing can be repaired: what is in use makes safe, what is not is refused.
// The period is a parameter, too: a scrub that went by it would stand still.
TEST_F(ComponentMemory, AFlipOfThePeriodDoesNotStopTheScrub) {
  VERIFIES("LASSO-IMG-017~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  auto* const period = const_cast<double*>(&component().mission().parameters.period_s);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(period);
  for (std::size_t i = 0; i < sizeof(double); ++i) bytes[i] = 0;
  scene_->run_frames(50);
  EXPECT_TRUE(scene_->told(EventId::kMemoryCorrupt));
  EXPECT_EQ(*period, MemoryScene::parameters().period_s);
}

// The other buffer holds no image that could be flown with.
TEST_F(ComponentMemory, AFlipOfWhichImageIsActiveIsToldAndPosesGoOn) {
  VERIFIES("LASSO-HLT-014~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  constexpr std::uint32_t kCopies[] = {0, ~0u, 0};
  auto* const words = reinterpret_cast<std::uint32_t*>(const_cast<ImageKeeper*>(&component().images()));
  auto* const copies = std::search(words, words + sizeof(ImageKeeper) / sizeof(std::uint32_t), kCopies, kCopies + 3);
  ASSERT_NE(copies, words + sizeof(ImageKeeper) / sizeof(std::uint32_t));
  reinterpret_cast<std::size_t*>(copies)[-1] = 1;
  const std::uint32_t before = component().faults().confirmations();
  EXPECT_TRUE(all_valid(scene_->run_frames(5)));
  EXPECT_EQ(component().faults().confirmations(), before + 1);
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageCorrupt));
  EXPECT_EQ(component().images().active_number(), 0);
}

TEST_F(ComponentMemory, AnImageThatCannotBeRepairedMakesSafe) {
  VERIFIES("LASSO-IMG-016~1 LASSO-HLT-002~1");
  scene_->begin(first_image());
  scene_->run_frames(5);
  scene_->upload(better_image());
  scene_->store.broken = true;
  scene_->buffer(1)[2000] ^= 4;
  scene_->run_frames(50);
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageCorrupt));
  EXPECT_EQ(component().images().other().state(), ImageState::kRefused);
  EXPECT_TRUE(all_valid(scene_->run_frames(5))) << "nobody uses it";
  scene_->buffer(0)[2000] ^= 4;
  scene_->run_frames(50);
  EXPECT_TRUE(component().faults().ever().has(Fault::kImageLost));
  EXPECT_EQ(scene_->run_frames(1).back().mode, static_cast<std::uint8_t>(TrackingMode::kSafe));
}

// The image before decays while the new one is on trial: there is nothing to go back to, and yet a way on.
TEST_F(ComponentMemory, ATrialThatFailsWithNothingToGoBackToLeavesAWayOn) {
  VERIFIES("LASSO-IMG-014~1");
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

TEST_F(ComponentMemory, AnImageOfAnotherTargetDoesNotEndModeSafe) {
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
