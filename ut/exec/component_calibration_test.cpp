// Calibrations of the component's sensors: those of the active image, and the one of them that a command selects.
#include "ut/exec/component_operator.hpp"
#include "ut/exec/memory_scene.hpp"
#include "ut/support/box_calibrations.hpp"

namespace lasso {
namespace {

using test::all_valid;
using test::crc_of;
using test::first_image;
using test::MemoryScene;
using test::TestImage;

// For a camera of each serial number.
TestImage calibrated_image(const std::vector<std::uint32_t>& serials) {
  test::BoxTables tables = test::make_box_tables({test::BoxModel{}});
  for (const std::uint32_t serial : serials) {
    test::append_calibration(0, test::bent_calibration(serial), tables[test::kCalibrationsTable]);
  }
  return test::make_image(MemoryScene::parameters(), tables);
}

class ComponentCalibration : public test::MemoryFixture {
 protected:
  ServiceRefusal select(int sensor, int calibration) {
    const CalibrationCommand choice{static_cast<std::uint8_t>(sensor), static_cast<std::uint8_t>(calibration)};
    EXPECT_TRUE(component().receive_packet(test::view(test::select_calibration(choice, count_++)), component().next_slot_us()));
    return test::answer_in(test::packets_of(test::telemetry_of(component())));
  }

 private:
  std::uint16_t count_ = 1;
};

// From the first scan, with a new image, and back again to what the sensor was made with.
TEST_F(ComponentCalibration, SensorsAreCalibratedAsTheActiveImageSays) {
  VERIFIES("LASSO-LCS-007~2");
  scene_->sensor.serial = 99;
  scene_->begin(first_image());
  scene_->run_frames(3);
  EXPECT_EQ(scene_->sensor.serial, 0U) << "the image has none";
  const TestImage calibrated = calibrated_image({31});
  scene_->upload(calibrated);
  EXPECT_EQ(scene_->sensor.serial, 0U) << "not active yet";
  ASSERT_EQ(component().activate_image(crc_of(calibrated)), ImageRefusal::kNone);
  scene_->run_frames(20);
  EXPECT_EQ(scene_->sensor.serial, 31U);
  ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 0U);
}

TEST_F(ComponentCalibration, ACalibrationComesBackWithTheStoredImage) {
  VERIFIES("LASSO-LCS-007~2 LASSO-LCS-020~1");
  scene_->begin(first_image());
  scene_->run_frames(3);
  const TestImage calibrated = calibrated_image({31, 32});
  scene_->upload(calibrated);
  ASSERT_EQ(component().activate_image(crc_of(calibrated)), ImageRefusal::kNone);
  scene_->run_frames(20);
  EXPECT_TRUE(scene_->told(EventId::kImageConfirmed));
  EXPECT_EQ(select(0, 1), ServiceRefusal::kNone);
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 32U);
  scene_->restart();
  scene_->sensor.serial = 0;
  ASSERT_EQ(component().load_stored_image().status, Status::kOk);
  ASSERT_EQ(component().begin(0), Status::kOk);
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 31U) << "the first one, whatever was selected before the restart";
}

// A flip in a record that is in use is reported and repaired; until then the sensor has what was right.
TEST_F(ComponentCalibration, ACalibrationThatDecaysIsNotBelieved) {
  VERIFIES("LASSO-LCS-007~2 LASSO-LCS-015~2");
  scene_->begin(calibrated_image({31}));
  scene_->run_frames(3);
  ASSERT_EQ(scene_->sensor.serial, 31U);
  test::TestImage as_sent = calibrated_image({31});
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
TEST_F(ComponentCalibration, AnImageForAnotherCameraIsTakenBack) {
  VERIFIES("LASSO-IMG-014~2 LASSO-LCS-015~2");
  scene_->sensor.own_serial = 31;
  scene_->begin(calibrated_image({31}));
  EXPECT_TRUE(all_valid(scene_->run_frames(10)));
  const TestImage foreign = calibrated_image({32});
  scene_->upload(foreign);
  ASSERT_EQ(component().activate_image(crc_of(foreign)), ImageRefusal::kNone);
  scene_->run_frames(12);
  EXPECT_EQ(scene_->last(EventId::kImageActive).items[4], 1) << "rolled back";
  EXPECT_EQ(scene_->sensor.serial, 31U);
  scene_->run_frames(8);
  EXPECT_EQ(scene_->run_frames(1).back().valid, 1);
}

// By command, from the next scan on; of several the first holds until then, and again with another image.
TEST_F(ComponentCalibration, ACommandSelectsTheCalibration) {
  VERIFIES("LASSO-LCS-020~1");
  scene_->begin(calibrated_image({31, 32, 33, 34}));
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 31U);
  EXPECT_EQ(select(0, 3), ServiceRefusal::kNone);
  EXPECT_EQ(scene_->sensor.serial, 31U) << "the scan under way keeps its own";
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 34U);
  const std::vector<std::uint8_t> told = scene_->last(EventId::kCalibrationSelected).items;
  EXPECT_EQ(told, (std::vector<std::uint8_t>{0, 3, 0, 0, 0, 34}));
  EXPECT_EQ(select(0, 1), ServiceRefusal::kNone);
  scene_->run_frames(1);
  EXPECT_EQ(scene_->sensor.serial, 32U);
  const TestImage other = calibrated_image({41, 42});
  scene_->upload(other);
  ASSERT_EQ(component().activate_image(crc_of(other)), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 41U);
  EXPECT_EQ(select(0, 1), ServiceRefusal::kNone);
  ASSERT_EQ(component().roll_back_image(), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 32U) << "as it was with that image";
  ASSERT_EQ(component().activate_image(crc_of(other)), ImageRefusal::kNone);
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 41U) << "activated anew";
}

// Told in telemetry; what the sensor was made with is none of the image's.
TEST_F(ComponentCalibration, TelemetrySaysWhichOneScansGoBy) {
  VERIFIES("LASSO-LCS-020~1");
  const auto made = std::make_unique<AcquisitionTask>(only(scene_->sensor));
  AcquisitionTask& task = *made;
  EXPECT_EQ(task.tally(0).calibration, kOwnCalibration) << "no scan yet";
  scene_->begin(calibrated_image({31, 32}));
  task.calibrate(0, component().images().active());
  EXPECT_EQ(task.tally(0).calibration, 0);
  task.choose_calibration(0, 1);
  task.calibrate(0, component().images().active());
  EXPECT_EQ(task.tally(0).calibration, 1);
  EXPECT_EQ(scene_->sensor.serial, 32U);
  task.choose_calibration(0, 3);
  task.calibrate(0, component().images().active());
  EXPECT_EQ(task.tally(0).calibration, kOwnCalibration);
}

// Of three copies of the choices two hold, and the third is set right before the next scan.
TEST_F(ComponentCalibration, AFlippedChoiceIsOutvoted) {
  VERIFIES("LASSO-LCS-020~1");
  scene_->begin(calibrated_image({31, 32, 33}));
  EXPECT_EQ(select(0, 2), ServiceRefusal::kNone);
  constexpr std::uint32_t kCopies[] = {2, ~2U, 2};
  auto* const words = reinterpret_cast<std::uint32_t*>(&component());
  auto* const end = words + sizeof(Component) / sizeof(std::uint32_t);
  auto* const copies = std::search(words, end, kCopies, kCopies + 3);
  ASSERT_NE(copies, end);
  ASSERT_EQ(std::search(copies + 3, end, kCopies, kCopies + 3), end) << "no other three words say that";
  for (const int flipped : {0, 1, 2}) {
    copies[flipped] ^= 3U;
    scene_->run_frames(2);
    EXPECT_EQ(scene_->sensor.serial, 33U);
    EXPECT_TRUE(std::equal(kCopies, kCopies + 3, copies)) << "all three";
  }
}

TEST_F(ComponentCalibration, WhatTheImageDoesNotHaveIsRefused) {
  VERIFIES("LASSO-LCS-020~1");
  scene_->begin(calibrated_image({31, 32}));
  EXPECT_EQ(select(0, 1), ServiceRefusal::kNone);
  for (const int calibration : {2, 3}) EXPECT_EQ(select(0, calibration), ServiceRefusal::kNoCalibration) << calibration;
  for (const int sensor : {1, 3}) EXPECT_EQ(select(sensor, 0), ServiceRefusal::kNoCalibration) << sensor;
  scene_->run_frames(2);
  EXPECT_EQ(scene_->sensor.serial, 32U) << "as it was";
}

}  // namespace
}  // namespace lasso
