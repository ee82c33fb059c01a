#include "hal_lcs/driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

constexpr std::uint32_t kSerial = 4242;
constexpr TimeUs kStartUs = 5'000'000;
constexpr double kDepthM = 3;

Calibration calibration() {
  Calibration c;
  c.serial = kSerial;
  return c;
}

ScanPlan small_plan(std::uint32_t scan_id = 0x301, std::uint16_t points = 40) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.points = points;
  plan.cycles_a = 5;
  plan.cycles_b = 3;
  plan.phase_turns = 0.3;
  plan.duration_us = 39'000;
  return plan;
}

// The camera's end of the line, by hand: what it does is what a test says.
class Camera {
 public:
  explicit Camera(Line& line) : line_(line) { heard(); }

  // Frames that have come since the last call.
  std::vector<Frame> heard() {
    std::vector<Frame> frames;
    std::uint8_t byte = 0;
    Frame frame;
    while (line_.to_camera.read(Bytes(&byte, 1)) == 1) {
      if (decoder_.step(ConstBytes(&byte, 1), frame).found) frames.push_back(frame);
    }
    return frames;
  }

  template <class Message>
  void say(const Message& message) {
    const FrameBytes bytes = encode(sequence++, message);
    line_.from_camera.write(bytes.span());
  }
  void status(std::uint32_t boots = 1, std::uint32_t serial = kSerial, bool lit = true) {
    CameraStatus status;
    status.serial = serial;
    status.boots = boots;
    status.temperature_degC = 22;
    status.laser_lit = lit;
    say(status);
  }
  // Answers the start among the frames.
  void answer(const std::vector<Frame>& frames, Result result = Result::kDone) {
    for (const Frame& frame : frames) {
      if (frame.type == static_cast<std::uint8_t>(Type::kStart)) say(Answer{Type::kStart, frame.sequence, result, clock_at_start_us});
    }
  }
  // A wall across the boresight, from the plan's ray `first` on.
  Samples wall(const ScanPlan& plan, std::uint16_t first, std::size_t count = kSamplesPerFrame) const {
    const Calibration c = calibration();
    Samples samples;
    samples.tag = tag_of(plan.scan_id);
    samples.first = first;
    samples.count = count;
    for (std::size_t i = 0; i < count; ++i) {
      const auto ray = static_cast<std::uint16_t>(first + i);
      const Vec3 u = pattern_direction(plan, ray);
      RawSample& raw = samples.samples[i];
      raw.kind = SampleKind::kReturn;
      raw.angle_x_rad = std::atan(u.x() / u.z());
      raw.angle_y_rad = std::atan(u.y() / u.z());
      raw.peak = (c.focal_length_m * c.baseline_m / kDepthM - c.focal_length_m * u.x() / u.z()) / c.half_width_m;
      raw.clock_us = clock_at_start_us + static_cast<std::uint32_t>(pattern_time_us(plan, ray));
    }
    return samples;
  }

  std::uint8_t sequence = 0;
  std::uint32_t clock_at_start_us = 0xFFFFF000;  // wraps within the scan

 private:
  Line& line_;
  FrameDecoder decoder_;
};

class LcsDriver : public ::testing::Test {
 protected:
  LcsDriver() { driver.permit_laser(true); }

  // A scan that the camera has taken on.
  void begin(const ScanPlan& plan) {
    ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
    camera.status();
    camera.answer(camera.heard());
  }
  SensorPoll poll(TimeUs now_us = kStartUs + 45'000) {
    const SensorPoll result = driver.poll(now_us, Span<RangeSample>(out));
    for (std::size_t i = 0; i < result.count; ++i) samples.push_back(out[i]);
    return result;
  }
  std::uint32_t lost(Loss loss) const { return driver.health().scans_lost[static_cast<std::size_t>(loss)]; }
  std::uint32_t fate(Triangulation::Fate fate) const { return driver.health().fates[static_cast<std::size_t>(fate)]; }

  Line line;
  Driver driver{line, calibration()};
  Camera camera{line};
  RangeSample out[kMaxSamplesPerPoll];
  std::vector<RangeSample> samples;
};

TEST_F(LcsDriver, BringsAScanFromPlanToPoints) {
  VERIFIES("LASSO-LCS-007~1");
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
    EXPECT_EQ(sample.t_us - kStartUs - pattern_time_us(plan, ray), 195);  // the command's 78 bytes at 4 Mbit/s
  }
  EXPECT_EQ(driver.camera().serial, kSerial);
  EXPECT_EQ(driver.poll(kStartUs + 46'000, Span<RangeSample>(out)).status, Status::kNoData);
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

// Commands to the laser among the frames.
std::vector<LaserCommand> laser_commands(const std::vector<Frame>& frames) {
  std::vector<LaserCommand> commands;
  for (const Frame& frame : frames) {
    LaserCommand command{};
    if (frame.type == static_cast<std::uint8_t>(Type::kLaser) && decode(frame, command) == Status::kOk) commands.push_back(command);
  }
  return commands;
}
const std::vector<LaserCommand> kNone, kInhibit = {LaserCommand::kInhibit}, kLight = {LaserCommand::kArm, LaserCommand::kFire};

class DarkDriver : public LcsDriver {
 protected:
  DarkDriver() { driver.permit_laser(false); }
  std::vector<LaserCommand> heard() {
    frames = camera.heard();
    return laser_commands(frames);
  }
  std::vector<Frame> frames;
};

TEST_F(DarkDriver, LightsTheLaserOnlyWithPermission) {
  VERIFIES("LASSO-LCS-006~1");
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing);
  for (const LaserCommand command : heard()) EXPECT_EQ(command, LaserCommand::kInhibit);
  EXPECT_EQ(lost(Loss::kInhibited), 1U);
  driver.permit_laser(true);
  EXPECT_EQ(heard(), kNone);
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  EXPECT_EQ(heard(), kLight);
}

TEST_F(DarkDriver, InhibitsWithEachCallUntilTheCameraConfirmsIt) {
  VERIFIES("LASSO-LCS-006~1");
  heard();
  poll();
  EXPECT_EQ(heard(), kInhibit);
  driver.abort();
  EXPECT_EQ(heard(), kInhibit);
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing);
  EXPECT_EQ(heard(), kInhibit);
  const std::uint8_t sequence = frames.back().sequence;
  camera.say(Answer{Type::kLaser, static_cast<std::uint8_t>(sequence - 1), Result::kDone, 0});  // to another one
  camera.say(Answer{Type::kLaser, sequence, Result::kUnknown, 0});
  poll();
  EXPECT_EQ(heard(), kInhibit);
  const Answer confirmed{Type::kLaser, frames.back().sequence, Result::kDone, 0};
  for (int said = 0; said < 2; ++said) {
    camera.say(confirmed);
    poll();
    EXPECT_EQ(heard(), kNone);
  }
  camera.status(1, kSerial, false);
  poll();
  EXPECT_EQ(heard(), kNone);
  camera.status();  // and yet it is lit
  poll();
  EXPECT_EQ(heard(), kInhibit);
}

TEST(LcsDriverAnew, InhibitsACameraThatMayBeLit) {
  VERIFIES("LASSO-LCS-006~1");
  Line line;
  Camera camera(line);
  const Driver driver(line, calibration());
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
}

TEST_F(LcsDriver, IsNotLitTwice) {
  begin(small_plan());
  poll();
  driver.abort();
  ASSERT_EQ(driver.start(small_plan(2), kStartUs), Status::kOk);
  for (const Frame& frame : camera.heard()) EXPECT_NE(frame.type, static_cast<std::uint8_t>(Type::kLaser));
}

TEST_F(LcsDriver, InhibitingEndsTheScanAndReachesTheCamera) {
  VERIFIES("LASSO-LCS-006~1");
  begin(small_plan());
  poll();
  driver.permit_laser(false);
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_EQ(lost(Loss::kInhibited), 1U);
  EXPECT_EQ(driver.start(small_plan(2), kStartUs), Status::kMissing);
}

TEST_F(LcsDriver, InhibitingWaitsForALineThatIsFull) {
  VERIFIES("LASSO-LCS-004~1 LASSO-LCS-006~1");
  const std::vector<std::uint8_t> block(kLineBytes, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kOverCapacity);
  EXPECT_EQ(lost(Loss::kLineFull), 1U);
  driver.permit_laser(false);
  driver.abort();
  EXPECT_TRUE(camera.heard().empty());
  driver.abort();
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
}

TEST_F(LcsDriver, ALineThatIsNearlyFullKeepsRoomForAnInhibit) {
  VERIFIES("LASSO-LCS-006~1");
  begin(small_plan());
  poll();
  const std::vector<std::uint8_t> block(kLineBytes - 2 * kMaxFrame + 1, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  driver.permit_laser(false);
  const std::vector<Frame> frames = camera.heard();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(laser_commands(frames), kInhibit);
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

TEST_F(LcsDriver, ADamagedFrameLosesItsSamplesAlone) {
  VERIFIES("LASSO-LCS-002~1");
  const ScanPlan plan = small_plan();
  begin(plan);
  for (std::uint16_t first = 0; first < plan.points; first += 4) {
    if (first == 12 || first == 36)
      ++camera.sequence;  // on the way these were lost
    else
      camera.say(camera.wall(plan, first));
  }
  camera.say(ScanEnd{tag_of(plan.scan_id), plan.points, true});
  EXPECT_TRUE(poll().complete);
  ASSERT_EQ(samples.size(), plan.points);
  for (std::size_t ray = 0; ray < samples.size(); ++ray)
    EXPECT_EQ(samples[ray].state == RayState::kLost, (ray >= 12 && ray < 16) || ray >= 36) << ray;
  EXPECT_EQ(driver.health().samples_lost, 8U);
  EXPECT_EQ(driver.health().sequence_gaps, 2U);
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

TEST_F(LcsDriver, RepeatedStrayAndForeignSamplesAreDropped) {
  VERIFIES("LASSO-LCS-014~2");
  const ScanPlan plan = small_plan();
  camera.say(camera.wall(plan, 0));  // before any scan
  camera.say(ScanEnd{tag_of(plan.scan_id), 40, true});
  begin(plan);
  camera.say(camera.wall(plan, 0));
  camera.say(camera.wall(plan, 0));
  camera.say(camera.wall(small_plan(0x302), 4));
  Samples beyond = camera.wall(plan, 36);
  beyond.first = 38;
  camera.say(beyond);
  camera.say(ScanEnd{0x77, 40, true});
  poll();
  EXPECT_EQ(samples.size(), 4U);
  EXPECT_EQ(driver.health().strayed, 4U + 1 + 4 + 4 + 4 + 1);
}

TEST_F(LcsDriver, MessagesThatSayNothingDefinedAreCounted) {
  VERIFIES("LASSO-LCS-014~2");
  begin(small_plan());
  camera.say(Type::kAbort);    // no word of a camera's
  camera.say(Type::kSamples);  // without samples
  poll();
  EXPECT_EQ(driver.health().bad_messages, 2U);
}

TEST_F(LcsDriver, SilenceIsATimeout) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  EXPECT_EQ(poll(kStartUs + kAnswerTimeoutUs).status, Status::kOk);
  EXPECT_EQ(poll(kStartUs + kAnswerTimeoutUs + 1).status, Status::kTimeout);
  EXPECT_EQ(lost(Loss::kSilent), 1U);
  EXPECT_EQ(driver.start(small_plan(2), kStartUs + 200'000), Status::kOk);
}

TEST_F(LcsDriver, ARefusalIsTheScansReason) {
  VERIFIES("LASSO-LCS-012~1");
  const std::pair<Result, Status> cases[] = {
      {Result::kBusy, Status::kBusy}, {Result::kBadPlan, Status::kBadValue}, {Result::kInhibited, Status::kMissing}};
  for (const auto& [result, status] : cases) {
    ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
    camera.status();
    camera.answer(camera.heard(), result);
    EXPECT_EQ(poll().status, status);
    EXPECT_EQ(driver.health().refused[static_cast<std::size_t>(result)], 1U);
  }
  EXPECT_EQ(lost(Loss::kRefused), 2U);
  EXPECT_EQ(lost(Loss::kInhibited), 1U);
  // The laser went out: it is lit anew.
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  int laser = 0;
  for (const Frame& frame : camera.heard()) laser += frame.type == static_cast<std::uint8_t>(Type::kLaser);
  EXPECT_EQ(laser, 2);
}

TEST_F(LcsDriver, AnswersToNoQuestionStray) {
  camera.say(Answer{Type::kStart, 0, Result::kDone, 0});
  camera.say(Answer{Type::kAbort, 0, Result::kDone, 0});  // heard, and of no consequence
  poll();
  EXPECT_EQ(driver.health().strayed, 1U);
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  camera.say(Answer{Type::kStart, 200, Result::kDone, 0});
  poll(kStartUs + 1000);
  EXPECT_EQ(driver.health().strayed, 2U);
}

TEST_F(LcsDriver, ABootEndsTheScan) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  begin(small_plan());
  poll();
  camera.status(2);
  EXPECT_EQ(poll().status, Status::kBadOrder);
  EXPECT_EQ(lost(Loss::kBooted), 1U);
  EXPECT_EQ(driver.health().boots, 1U);
  camera.status(3);  // between scans it costs none
  poll();
  EXPECT_EQ(driver.health().boots, 2U);
  EXPECT_EQ(lost(Loss::kBooted), 1U);
}

TEST_F(LcsDriver, AnotherCamerasCalibrationIsNotUsed) {
  VERIFIES("LASSO-LCS-015~1");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  camera.status(1, kSerial + 1);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(lost(Loss::kForeign), 1U);
}

TEST_F(LcsDriver, ACameraThatHasNotSaidWhichItIsGivesNoPoint) {
  VERIFIES("LASSO-LCS-015~1");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  camera.status(1, kSerial + 1);  // between scans
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  camera.answer(camera.heard());
  camera.say(camera.wall(small_plan(), 0));
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(lost(Loss::kForeign), 2U);
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

TEST_F(LcsDriver, AScanThatTheCameraEndsIsLost) {
  begin(small_plan());
  camera.say(ScanEnd{tag_of(0x301), 12, false});
  EXPECT_EQ(poll().status, Status::kTruncated);
  EXPECT_EQ(lost(Loss::kStopped), 1U);
}

TEST_F(LcsDriver, MirrorsThatDoNotFollowThePlanLoseTheScan) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-014~2");
  const ScanPlan plan = small_plan(0x301, 100);
  for (const bool vertical : {false, true}) {
    begin(plan);
    for (std::uint16_t first = 0; first < plan.points; first += 4) {
      Samples samples_off = camera.wall(plan, first);
      (vertical ? samples_off.samples[0].angle_y_rad : samples_off.samples[0].angle_x_rad) += first % 8 == 0 ? 0.02 : -0.02;
      camera.say(samples_off);
    }
    EXPECT_EQ(poll().status, Status::kBadValue);
    EXPECT_EQ(camera.heard().back().type, static_cast<std::uint8_t>(Type::kAbort));  // it does not dwell there
  }
  EXPECT_EQ(lost(Loss::kOffPlan), 2U);
  EXPECT_EQ(driver.health().off_plan, 2 * kOffPlanFrames);
}

TEST_F(LcsDriver, RaysThatWereNotAimedAreNotOffPlan) {
  const ScanPlan plan = small_plan();
  begin(plan);
  Samples samples_off = camera.wall(plan, 0, 1);
  samples_off.samples[0].kind = SampleKind::kNotAimed;
  samples_off.samples[0].angle_x_rad = 0.25;
  camera.say(samples_off);
  poll();
  EXPECT_EQ(driver.health().off_plan, 0U);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].state, RayState::kInvalid);
  EXPECT_EQ(fate(Triangulation::Fate::kNoStatement), 1U);
}

TEST_F(LcsDriver, TimesThatGoBackOrStrayFromThePlanMakeNoPoint) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-014~2");
  const ScanPlan plan = small_plan();
  begin(plan);
  Samples first = camera.wall(plan, 0);
  first.samples[2].clock_us = first.samples[0].clock_us;  // before samples[1]
  camera.say(first);
  Samples second = camera.wall(plan, 4);
  for (RawSample& raw : second.samples) raw.clock_us += static_cast<std::uint32_t>(kClockToleranceUs) + 1;
  camera.say(second);
  Samples third = camera.wall(plan, 20);
  for (RawSample& raw : third.samples) raw.clock_us -= static_cast<std::uint32_t>(kClockToleranceUs) + 1;
  camera.say(third);
  poll();
  ASSERT_EQ(samples.size(), 24U);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i].state == RayState::kHit, i < 2 || i == 3) << i;
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GE(samples[i].t_us, samples[i - 1].t_us) << i;
  EXPECT_EQ(driver.health().bad_times, 9U);
  EXPECT_EQ(driver.health().samples_lost, 12U);
}

TEST_F(LcsDriver, AClockThatJumpsIsTiedAnew) {
  VERIFIES("LASSO-LCS-011~1");
  begin(small_plan());
  poll();
  for (const std::int32_t jump_us : {700'000, -900'000}) {
    driver.abort();
    camera.heard();
    camera.clock_at_start_us += static_cast<std::uint32_t>(jump_us);
    begin(small_plan());
    camera.say(camera.wall(small_plan(), 0));
    poll();
    ASSERT_EQ(samples.size(), 4U);
    EXPECT_EQ(samples[0].state, RayState::kHit);
    samples.clear();
  }
  EXPECT_EQ(driver.health().clock_jumps, 2U);
}

TEST_F(LcsDriver, AClockThatWrapsBetweenScansHasNotJumped) {
  VERIFIES("LASSO-LCS-011~1");
  begin(small_plan());
  poll();
  driver.abort();
  constexpr DurationUs kLaterUs = 3'000'000'000;  // 50 minutes: more than half of the clock
  ASSERT_EQ(driver.start(small_plan(), kStartUs + kLaterUs), Status::kOk);
  const std::vector<Frame> frames = camera.heard();
  camera.clock_at_start_us += static_cast<std::uint32_t>(kLaterUs);
  camera.answer(frames);
  poll(kStartUs + kLaterUs + 1000);
  EXPECT_EQ(driver.health().clock_jumps, 0U);
}

TEST_F(LcsDriver, ATieOfLongAgoTimesNoSamples) {
  begin(small_plan());
  poll();
  driver.abort();
  ASSERT_EQ(driver.start(small_plan(), kStartUs + kTieUs + 1'000'000), Status::kOk);
  camera.say(camera.wall(small_plan(), 0));
  poll(kStartUs + kTieUs + 1'001'000);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(driver.health().strayed, 4U);
}

TEST_F(LcsDriver, ADamagedAnswerCostsNoScanOnceTheClockIsKnown) {
  const ScanPlan plan = small_plan();
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  camera.status();
  camera.say(camera.wall(plan, 0));  // the clock is not known yet
  poll(kStartUs + 1000);
  EXPECT_TRUE(samples.empty());
  camera.answer(camera.heard());
  poll(kStartUs + 2000);
  driver.abort();
  camera.heard();
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  camera.say(camera.wall(small_plan(0x302), 0));
  poll(kStartUs + 1000);
  EXPECT_TRUE(samples.empty());
  camera.say(camera.wall(plan, 0));
  poll(kStartUs + 2000);
  EXPECT_EQ(samples.size(), 4U);
}

TEST_F(LcsDriver, AnAbortedScanIsCountedAndTold) {
  VERIFIES("LASSO-LCS-012~1");
  begin(small_plan());
  poll();
  driver.abort();
  EXPECT_EQ(lost(Loss::kUnfinished), 1U);
  EXPECT_EQ(camera.heard().back().type, static_cast<std::uint8_t>(Type::kAbort));
  driver.abort();
  EXPECT_EQ(lost(Loss::kUnfinished), 1U);
  camera.status();  // in no scan: heard, no more
  EXPECT_EQ(poll().status, Status::kNoData);
  begin(small_plan());
  const std::vector<std::uint8_t> block(kLineBytes, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  driver.abort();
  EXPECT_EQ(lost(Loss::kUnfinished), 2U);
}

TEST_F(LcsDriver, BabbleIsReadWithinTheBound) {
  VERIFIES("LASSO-LCS-004~1");
  const ScanPlan plan = small_plan();
  begin(plan);
  poll();
  test::Generator chance(77);
  std::vector<std::uint8_t> babble(kLineBytes);
  for (std::uint8_t& byte : babble) byte = static_cast<std::uint8_t>(chance.below(3) == 0 ? 0x5A : 0xC3);
  line.from_camera.write(ConstBytes(babble.data(), babble.size()));
  EXPECT_EQ(poll().status, Status::kOk);
  EXPECT_EQ(line.from_camera.room(), kLineBytes);
  EXPECT_GT(driver.line_counters().skipped, kLineBytes - 2 * kMaxFrame);
  for (int i = 0; i < 3; ++i) camera.say(Type::kAbort);  // fills what a false beginning waits for
  camera.say(camera.wall(plan, 0));
  poll();
  EXPECT_EQ(samples.size(), 4U);
}

TEST(LcsDriverDeath, CalibrationThatIsNotValid) {
  Line line;
  Calibration bad;
  bad.baseline_m = 0;
  EXPECT_DEATH(Driver(line, bad), "lcs calibration");
}

}  // namespace
}  // namespace lasso::lcs
