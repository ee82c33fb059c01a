#include "hal_lcs/driver.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ut/hal_lcs/driver_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

constexpr std::uint8_t kNoise[200] = {};

TEST_F(LcsDriver, BringsAScanFromPlanToPoints) {
  VERIFIES("LASSO-LCS-007~2");
  const ScanPlan plan = small_plan();
  begin(plan);
  EXPECT_FALSE(poll(kStartUs + 1000).complete);
  for (std::uint16_t first = 0; first < plan.points; first += 4) camera.say(camera.wall(plan, first));
  const SensorPoll result = poll();
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_TRUE(result.complete);
  ASSERT_EQ(samples.size(), plan.points);
  for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
    const RangeSample& sample = samples[ray];
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_NEAR(static_cast<double>(sample.range_m * sample.direction[2]), kDepthM, 2e-5);  // steps of the wire
    const Vec3 u = pattern_direction(plan, ray);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(sample.direction[k]), u[k], 3e-7);
    EXPECT_EQ(sample.t_us - kStartUs - pattern_time_us(plan, ray), kStartDelayUs);
  }
  EXPECT_EQ(camera.delay_us, kStartDelayUs - 195);  // the command's 78 bytes at 4 Mbit/s
  EXPECT_EQ(driver.camera().serial, kSerial);
  EXPECT_EQ(driver.poll(kStartUs + 46'000, Span<RangeSample>(out)).status, Status::kNoData);
}

// By its whole start, byte for byte: what a head is does not show on the line to it.
TEST(LcsDriverOfEachHead, SpeaksToItAsToALaserCamera) {
  VERIFIES("LASSO-LCS-016~2");
  EchoCalibration echo;
  echo.serial = kSerial;
  const auto start_of = [](const Optics& optics) {
    Line line;
    Driver driver(line, optics);
    Sensor& sensor = driver;  // the interface of every sensor
    sensor.permit_laser(true);
    AimedRays aimed;
    for (int i = 0; i < 9; ++i) EXPECT_TRUE(aimed.push_back({0.01F * static_cast<float>(i), -0.02F}));
    ScanPlan plan = small_plan();
    plan.aimed = aimed.span();
    EXPECT_EQ(sensor.start(plan, kStartUs), Status::kOk);
    std::vector<std::uint8_t> bytes(kLineBytes);
    bytes.resize(line.to_camera.read(Bytes(bytes.data(), bytes.size())));
    return bytes;
  };
  const std::vector<std::uint8_t> camera = start_of(Optics(calibration()));
  EXPECT_GT(camera.size(), 100U);
  EXPECT_EQ(start_of(Optics(echo)), camera) << "a LIDAR";
  EXPECT_EQ(start_of(Optics(calibration(), echo)), camera) << "a TriDAR";
}

TEST_F(LcsDriver, TheFirstSampleWaitsForNothingButALineThatIsFull) {
  VERIFIES("LASSO-LCS-003~1");
  line.bits_per_s = 1e6;
  begin(small_plan());
  EXPECT_EQ(camera.delay_us, kStartDelayUs - 780) << "78 bytes";
  driver.abort();
  camera.heard();
  line.to_camera.write(ConstBytes(kNoise, sizeof kNoise));
  begin(small_plan());
  EXPECT_EQ(camera.delay_us, 0U);
  camera.say(camera.wall(small_plan(), 0));
  poll();
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_GT(samples[0].t_us, kStartUs + 2'000) << "200 bytes before the command";
}

// Its wall is at 3 m by the calibration that the driver was made with; half the baseline halves the depths.
TEST_F(LcsDriver, BelievesTheCalibrationThatItIsGiven) {
  VERIFIES("LASSO-LCS-007~2 LASSO-LCS-008~2");
  Calibration other = calibration();
  other.baseline_m /= 2;
  other.depth_max_m = kDepthM / 2.1;  // the wall is a little beyond
  const auto scanned = [&](const Calibration* given) {
    driver.use_calibration(given);
    samples.clear();
    const ScanPlan plan = small_plan();
    begin(plan);
    for (std::uint16_t first = 0; first < plan.points; first += 4) camera.say(camera.wall(plan, first));
    EXPECT_TRUE(poll().complete);
    return static_cast<double>(samples.at(7).range_m * samples.at(7).direction[2]);
  };
  EXPECT_NEAR(scanned(&other), kDepthM / 2, 2e-5);
  EXPECT_EQ(samples.at(7).sigma_factor, static_cast<float>(other.outside_sigma_factor));
  EXPECT_EQ(driver.counters().samples_outside, small_plan().points);
  EXPECT_EQ(driver.counters().samples_refused, 0U);
  EXPECT_NEAR(scanned(nullptr), kDepthM, 2e-5) << "as it was made";
  EXPECT_EQ(samples.at(7).sigma_factor, 1);
  EXPECT_EQ(driver.counters().samples_outside, small_plan().points);
}

TEST_F(LcsDriver, ACalibrationOfAnotherCameraIsNotBelieved) {
  VERIFIES("LASSO-LCS-015~2");
  Calibration other = calibration();
  other.serial = kSerial + 1;
  driver.use_calibration(&other);
  begin(small_plan());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(lost(Loss::kForeign), 1U);
}

TEST_F(LcsDriver, TellsTheCameraThePlan) {
  VERIFIES("LASSO-LCS-001~1");
  AimedRays aimed;
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(aimed.push_back({0.01F * static_cast<float>(i), -0.02F}));
  ScanPlan plan = small_plan();
  plan.aimed = aimed.span();
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  const std::vector<Frame> frames = camera.heard();
  std::vector<int> types;
  for (const Frame& frame : frames) types.push_back(frame.type);
  EXPECT_EQ(types, (std::vector<int>{0x01, 0x02, 0x03, 0x03, 0x11, 0x10, 0x10}));
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(frames[i].sequence, frames[i - 1].sequence + 1);
  StartCommand start;
  ASSERT_EQ(decode(frames[4], start), Status::kOk);
  EXPECT_EQ(start.plan.scan_id, plan.scan_id);
  EXPECT_EQ(start.plan.points, plan.points);
  EXPECT_EQ(start.aimed, 8);
  AimCommand first, second;
  ASSERT_EQ(decode(frames[5], first), Status::kOk);
  ASSERT_EQ(decode(frames[6], second), Status::kOk);
  EXPECT_EQ(first.first + first.count, second.first);
  EXPECT_EQ(second.count, 2U);
  EXPECT_EQ(second.rays[1].x, aimed[7].x);
}

TEST_F(LcsDriver, RefusesWhatItCannotDo) {
  ScanPlan bad = small_plan();
  bad.points = 2;
  EXPECT_EQ(driver.start(bad, kStartUs), Status::kBadValue);
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  EXPECT_EQ(driver.start(small_plan(2), kStartUs), Status::kBusy);
  camera.status();
  camera.answer(camera.heard());
  poll();
  EXPECT_EQ(driver.start(small_plan(2), kStartUs), Status::kBusy);
}

TEST_F(LcsDriver, HandsOverNoMoreThanIsAskedFor) {
  VERIFIES("LASSO-LCS-004~1");
  const ScanPlan plan = small_plan();
  begin(plan);
  for (std::uint16_t first = 0; first < plan.points; first += 4) camera.say(camera.wall(plan, first));
  std::size_t count = 0;
  bool complete = false;
  for (int i = 0; i < 14 && !complete; ++i) {
    const SensorPoll result = driver.poll(kStartUs + 45'000, Span<RangeSample>(out, 3));
    EXPECT_LE(result.count, 3U);
    for (std::size_t k = 0; k < result.count; ++k) EXPECT_EQ(out[k].state, RayState::kHit);
    count += result.count;
    complete = result.complete;
  }
  EXPECT_TRUE(complete);
  EXPECT_EQ(count, plan.points);
}

TEST_F(LcsDriver, TheEndOfACompleteScanIsNoNews) {
  const ScanPlan plan = small_plan();
  begin(plan);
  for (std::uint16_t first = 0; first < plan.points; first += 4) camera.say(camera.wall(plan, first));
  EXPECT_TRUE(poll().complete);
  camera.say(ScanEnd{tag_of(plan.scan_id), plan.points, true});
  poll();
  EXPECT_EQ(driver.health().strayed, 0U);
}

TEST(LcsDriverDeath, CalibrationThatIsNotValid) {
  Line line;
  Calibration bad;
  bad.baseline_m = 0;
  EXPECT_DEATH(Driver(line, Optics(bad)), "lcs calibration");
}

TEST_F(LcsDriver, AKindOfHeadThatIsNotDefinedIsForeign) {
  VERIFIES("LASSO-LCS-015~2");
  begin(small_plan());
  camera.say(camera.wall(small_plan(), 0));
  camera.status();  // as before: nothing ends by it
  EXPECT_EQ(poll().status, Status::kOk);
  EXPECT_EQ(samples.size(), 4U);
  CameraStatus status;
  status.serial = kSerial;
  status.boots = 1;
  status.device = static_cast<Device>(3);
  camera.say(status);
  camera.say(camera.wall(small_plan(), 4));
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(samples.size(), 4U) << "what comes after it is not believed";
  EXPECT_EQ(lost(Loss::kForeign), 1U);
  EXPECT_EQ(driver.health().bad_messages, 0U);
  ASSERT_EQ(driver.start(small_plan(2), kStartUs), Status::kOk);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion) << "nor is it at the next start";
  EXPECT_EQ(lost(Loss::kForeign), 2U);
}

}  // namespace
}  // namespace lasso::lcs
