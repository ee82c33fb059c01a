#include "hal_lcs/head_driver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "ut/hal_lcs/driver_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

constexpr TimeUs kFirstUs = kStartUs + kStartDelayUs, kLaterUs = kStartUs + 45'000;

// The head's end of the memory, by hand: what it does is what a test says.
class Head {
 public:
  explicit Head(HeadMemory& memory) : memory_(memory) {}

  Frame command() const {
    Frame frame;
    EXPECT_TRUE(memory_.command.load(frame));
    return frame;
  }
  bool is_inhibited() const {
    LaserCommand said = LaserCommand::kFire;
    return command().type == static_cast<std::uint8_t>(Type::kLaser) && decode(command(), said) == Status::kOk &&
           said == LaserCommand::kInhibit;
  }
  std::uint16_t number() const { return value_of(memory_.commands.load()); }
  void say(bool scanning) {
    CameraStatus said = status;
    said.scanning = scanning;
    memory_.status.store(encode(sequence_of(number()), said));
  }
  void answer(Result result = Result::kDone) { memory_.answer.store(numbered(number(), static_cast<std::uint16_t>(result))); }
  void count(std::uint16_t samples) { memory_.samples.store(numbered(number(), samples)); }
  // Records of a wall across the boresight, up to ray `end`.
  void measure(const ScanPlan& plan, std::uint16_t end) {
    for (std::uint16_t ray = 0; ray < end; ++ray) {
      RawSample raw = wall_.wall(plan, ray, 1).samples[0];
      record(ray, raw, static_cast<std::uint32_t>(kFirstUs + pattern_time_us(plan, ray)));
    }
    count(end);
  }
  void record(std::uint16_t ray, const RawSample& sample, std::uint32_t clock_us) {
    RawSample raw = sample;
    raw.clock_us = clock_us;
    ByteWriter out{Bytes(memory_.records[ray])};
    out.u32(clock_us);
    write_sample(out, raw, clock_us);
  }

  CameraStatus status;

 private:
  HeadMemory& memory_;
  Line line_;
  Camera wall_{line_};
};

class LcsHeadDriver : public ::testing::Test {
 protected:
  LcsHeadDriver() {
    head.status.serial = kSerial;
    head.status.boots = 1;
    head.status.temperature_degC = 22;
    driver.permit_laser(true);
  }
  void begin(const ScanPlan& of) {
    ASSERT_EQ(driver.start(of, kStartUs), Status::kOk);
    head.say(true);
    head.count(0);
    head.answer();
  }
  SensorPoll poll(TimeUs now_us = kLaterUs) {
    const SensorPoll result = driver.poll(now_us, Span<RangeSample>(out));
    samples.insert(samples.end(), out, out + result.count);
    return result;
  }
  // A scan that ends for a reason that the head gives.
  void expect_lost(Status reason) {
    EXPECT_EQ(poll().status, reason);
    EXPECT_EQ(head.command().type, static_cast<std::uint8_t>(Type::kAbort));
    EXPECT_EQ(poll().status, Status::kNoData);
  }

  HeadMemory memory;
  HeadDriver driver{memory, Optics(calibration())};
  Head head{memory};
  ScanPlan plan = small_plan();
  RangeSample out[kMaxSamplesPerPoll];
  std::vector<RangeSample> samples;
};

TEST_F(LcsHeadDriver, BringsAScanFromPlanToPoints) {
  VERIFIES("LASSO-LCS-022~1");
  begin(plan);
  head.measure(plan, 10);
  EXPECT_EQ(poll(kStartUs + 12'000).count, 10U);
  head.measure(plan, plan.points);
  head.say(false);
  const SensorPoll last = poll();
  EXPECT_TRUE(last.complete);
  EXPECT_EQ(last.status, Status::kOk);
  ASSERT_EQ(samples.size(), plan.points);
  for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
    const RangeSample& sample = samples[ray];
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_NEAR(static_cast<double>(sample.range_m * sample.direction[2]), kDepthM, 2e-5);
    const Vec3 u = pattern_direction(plan, ray);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(sample.direction[k]), u[k], 3e-7);
    EXPECT_EQ(sample.t_us, kFirstUs + pattern_time_us(plan, ray));
  }
  EXPECT_EQ(poll().status, Status::kNoData);
}

TEST_F(LcsHeadDriver, GivesTheSamplesOfTheDriverAtALine) {
  VERIFIES("LASSO-LCS-022~1");
  Line line;
  Driver other(line, Optics(calibration()));
  Camera camera(line);
  other.permit_laser(true);
  ASSERT_EQ(other.start(plan, kStartUs), Status::kOk);
  camera.status();
  camera.answer(camera.heard());
  for (std::uint16_t first = 0; first < plan.points; first += kSamplesPerFrame) camera.say(camera.wall(plan, first));
  RangeSample expected[kMaxSamplesPerPoll];
  ASSERT_TRUE(other.poll(kLaterUs, Span<RangeSample>(expected)).complete);
  begin(plan);
  head.measure(plan, plan.points);
  ASSERT_TRUE(poll().complete);
  for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
    EXPECT_EQ(samples[ray].range_m, expected[ray].range_m);
    EXPECT_EQ(samples[ray].t_us, expected[ray].t_us);
    EXPECT_EQ(samples[ray].state, expected[ray].state);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(samples[ray].direction[k], expected[ray].direction[k]);
  }
}

TEST_F(LcsHeadDriver, TellsTheHeadWhatToScanAndWhen) {
  VERIFIES("LASSO-LCS-022~1");
  AimedRays aimed;
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(aimed.push_back({0.01F * static_cast<float>(i), -0.02F}));
  plan.aimed = aimed.span();
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  StartCommand command;
  ASSERT_EQ(decode(head.command(), command), Status::kOk);
  EXPECT_EQ(command.plan.scan_id, plan.scan_id);
  EXPECT_EQ(command.plan.points, plan.points);
  EXPECT_EQ(command.aimed, 9);
  EXPECT_EQ(static_cast<TimeUs>(ByteReader(ConstBytes(memory.first_us)).u64()), kFirstUs);
  ByteReader last{ConstBytes(memory.aimed[8])};
  EXPECT_EQ(last.f32(), 0.08F);
  EXPECT_EQ(last.f32(), -0.02F);
  EXPECT_EQ(head.command().sequence, memory.commands.load());
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kBusy);
  const std::uint32_t started = memory.commands.load();
  driver.abort();
  EXPECT_EQ(memory.commands.load(), started + 1);
  driver.abort();
  EXPECT_EQ(memory.commands.load(), started + 1) << "idle";
  plan.half_x = -1;
  EXPECT_EQ(driver.start(plan, kStartUs), validate(plan));
}

TEST_F(LcsHeadDriver, GoesOnFromWhatAnotherDriverHasLeft) {
  constexpr std::uint32_t kLeft[][3] = {{80, 80, 81},        // commands, answered: the first one of the next driver
                                        {80, 79, 81},        // one is open, and may be answered yet
                                        {80, 81, 82},        // after power-on
                                        {0x1234FFFF, 7, 0},  // wraps
                                        {0x1234FFFF, 0, 1}};
  for (const auto& [commands, answered, first] : kLeft) {
    memory.commands.store(commands);
    memory.answer.store(numbered(static_cast<std::uint16_t>(answered), 0));
    memory.laser.store(kLaserMayShine);
    HeadDriver next(memory, Optics(calibration()));
    EXPECT_EQ(memory.commands.load(), first);
    EXPECT_TRUE(head.is_inhibited());
    EXPECT_EQ(head.command().sequence, sequence_of(head.number()));
    EXPECT_NE(memory.laser.load(), kLaserMayShine);
    next.permit_laser(true);
    ASSERT_EQ(next.start(plan, kStartUs), Status::kOk);
    EXPECT_EQ(memory.commands.load(), first + 1);
    EXPECT_EQ(next.poll(kLaterUs, Span<RangeSample>(out)).count, 0U) << "nobody has answered";
  }
}

TEST_F(LcsHeadDriver, MakesDoWithWhateverTheMemoryHoldsAtPowerOn) {
  std::memset(static_cast<void*>(&memory), 0xA5, sizeof memory);
  HeadDriver next(memory, Optics(calibration()));
  next.permit_laser(true);
  ASSERT_EQ(next.start(plan, kStartUs), Status::kOk);
  EXPECT_EQ(next.poll(kLaterUs, Span<RangeSample>(out)).count, 0U);
  head.say(true);
  head.answer();
  head.measure(plan, plan.points);
  EXPECT_TRUE(next.poll(kLaterUs, Span<RangeSample>(out)).complete);
}

TEST_F(LcsHeadDriver, LetsTheLaserShineOnlyWithPermission) {
  VERIFIES("LASSO-LCS-006~1 LASSO-LCS-024~1");
  EXPECT_EQ(memory.laser.load(), kLaserMayShine);
  begin(plan);
  head.measure(plan, 10);
  driver.permit_laser(false);
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
  expect_lost(Status::kMissing);
  EXPECT_TRUE(samples.empty());
  memory.laser.store(kLaserMayShine);  // by a disturbance
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
  memory.laser.store(kLaserMayShine);
  poll();
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
}

TEST_F(LcsHeadDriver, AScanIsLostThoughPermissionIsBackBeforeItIsMissed) {
  VERIFIES("LASSO-LCS-006~1");
  begin(plan);
  head.measure(plan, plan.points);
  driver.permit_laser(false);
  driver.permit_laser(true);
  expect_lost(Status::kMissing);
  begin(plan);
  driver.permit_laser(true);
  head.measure(plan, plan.points);
  EXPECT_TRUE(poll().complete) << "the next one is not";
}

TEST_F(LcsHeadDriver, InhibitsAHeadThatSaysItIsLitWithoutPermission) {
  VERIFIES("LASSO-LCS-024~1");
  std::uint16_t given = head.number();
  const auto inhibited = [&] {
    const bool some = head.number() != given;
    given = head.number();
    return some && head.is_inhibited();
  };
  head.status.laser_lit = true;
  head.say(false);
  poll();
  EXPECT_FALSE(inhibited()) << "it may";
  driver.permit_laser(false);
  EXPECT_TRUE(inhibited());
  poll();
  EXPECT_TRUE(inhibited()) << "with each call";
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
  EXPECT_TRUE(inhibited());
  driver.abort();
  EXPECT_TRUE(inhibited());
  head.status.laser_lit = false;
  head.say(false);
  poll();
  EXPECT_FALSE(inhibited()) << "it is dark";
  head.status.laser_lit = true;
  head.say(false);
  reinterpret_cast<std::uint8_t*>(&memory.status)[7] ^= 1;
  poll();
  EXPECT_TRUE(inhibited()) << "nobody knows";
  head.say(false);
  head.status.laser_lit = false;
  head.say(false);
  driver.permit_laser(false);
  EXPECT_TRUE(inhibited()) << "whatever it says";
}

TEST_F(LcsHeadDriver, TheLastWordOfAScanWithoutPermissionIsAnInhibit) {
  VERIFIES("LASSO-LCS-024~1");
  head.status.laser_lit = true;
  begin(plan);
  driver.permit_laser(false);
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_TRUE(head.is_inhibited());
}

TEST_F(LcsHeadDriver, IsHeardWithEachCall) {
  VERIFIES("LASSO-LCS-024~1");
  std::uint32_t beats = memory.beats.load();
  const auto beaten = [&] {
    const std::uint32_t before = beats;
    beats = memory.beats.load();
    return beats != before;
  };
  begin(plan);
  EXPECT_TRUE(beaten());
  poll();
  EXPECT_TRUE(beaten());
  driver.abort();
  EXPECT_TRUE(beaten());
  driver.permit_laser(true);
  EXPECT_TRUE(beaten());
}

TEST_F(LcsHeadDriver, AFlippedBitOfThePermissionChangesNothing) {
  VERIFIES("LASSO-HLT-012~1");
  const std::uint32_t copies[] = {1, ~1u, 1};
  auto* words = reinterpret_cast<std::uint32_t*>(&driver);
  auto* end = words + sizeof(HeadDriver) / sizeof(std::uint32_t);
  auto* found = std::search(words, end, copies, copies + 3);
  ASSERT_NE(found, end);
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    found[bit / 32] ^= 1u << bit % 32;
    EXPECT_EQ(driver.start(plan, kStartUs), Status::kOk) << bit;
    EXPECT_EQ(memory.laser.load(), kLaserMayShine);
    EXPECT_TRUE(std::equal(copies, copies + 3, found)) << "repaired: " << bit;
    driver.abort();
  }
  begin(plan);
  found[0] = 5;
  found[1] = ~7u;
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_NE(memory.laser.load(), kLaserMayShine) << "what no two copies say is no permission";
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
}

TEST_F(LcsHeadDriver, LosesAScanForItsReason) {
  constexpr std::pair<Result, Status> kRefusals[] = {{Result::kInhibited, Status::kMissing},
                                                     {Result::kBusy, Status::kBusy},
                                                     {Result::kBadPlan, Status::kBadValue},
                                                     {static_cast<Result>(200), Status::kBadValue}};
  for (const auto& [result, reason] : kRefusals) {
    ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
    head.say(false);
    head.answer(result);
    expect_lost(reason);
  }
}

TEST_F(LcsHeadDriver, WaitsForAnAnswerButNotForLong) {
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  memory.samples.store(numbered(0, 12));  // of the scan before
  const SensorPoll waiting = poll(kFirstUs + kAnswerTimeoutUs);
  EXPECT_EQ(waiting.status, Status::kOk);
  EXPECT_EQ(waiting.count, 0U);
  EXPECT_EQ(poll(kFirstUs + kAnswerTimeoutUs + 1).status, Status::kTimeout);
}

// What is there of the scan before looks like a whole one of this.
TEST_F(LcsHeadDriver, TakesNothingOfTheScanBeforeInWhateverOrderTheHeadWrites) {
  VERIFIES("LASSO-LCS-022~1");
  begin(plan);
  head.measure(plan, plan.points);
  head.say(false);
  ASSERT_TRUE(poll().complete);
  std::vector<int> order = {0, 1, 2};
  do {
    ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
    for (const int step : order) {
      EXPECT_EQ(poll().count, 0U);
      if (step == 0) head.answer();
      if (step == 1) head.say(true);
      if (step == 2) head.count(0);
    }
    EXPECT_EQ(poll().count, 0U);
    head.measure(plan, plan.points);
    head.say(false);
    const SensorPoll last = poll();
    EXPECT_TRUE(last.complete);
    EXPECT_EQ(last.count, plan.points);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(LcsHeadDriver, AnAnswerOfTheScanBeforeRefusesNothing) {
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  head.answer(Result::kBusy);
  expect_lost(Status::kBusy);
  ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
  EXPECT_EQ(poll().status, Status::kOk);
}

TEST_F(LcsHeadDriver, AStatusOfAnotherCommandIsWaitedForAsAnAnswer) {
  begin(plan);
  head.measure(plan, plan.points);
  CameraStatus other = head.status;
  memory.status.store(encode(sequence_of(static_cast<std::uint16_t>(head.number() - 1)), other));
  const SensorPoll waiting = poll(kFirstUs + kAnswerTimeoutUs);
  EXPECT_EQ(waiting.status, Status::kOk);
  EXPECT_EQ(waiting.count, 0U);
  EXPECT_EQ(poll(kFirstUs + kAnswerTimeoutUs + 1).status, Status::kTimeout);
}

TEST_F(LcsHeadDriver, NoticesAHeadThatEndsEarlyOrStartsAnew) {
  begin(plan);
  head.measure(plan, 10);
  head.say(false);
  expect_lost(Status::kTruncated);
  begin(plan);
  EXPECT_EQ(poll().status, Status::kOk);
  head.status.boots = 2;
  head.say(true);
  expect_lost(Status::kBadOrder);
  EXPECT_EQ(driver.counters().restarts, 1U);
  begin(plan);
  EXPECT_EQ(poll().status, Status::kOk) << "the boot is told once";
  head.count(static_cast<std::uint16_t>(plan.points + 1));
  expect_lost(Status::kBadLength);
}

TEST_F(LcsHeadDriver, ABootBetweenScansIsCountedAndCostsNone) {
  for (const std::uint32_t boots : {0U, 1U, 2U, 2U, 5U}) {  // 0: as long as none is known
    head.status.boots = boots;
    begin(plan);
    head.measure(plan, plan.points);
    EXPECT_TRUE(poll().complete);
  }
  EXPECT_EQ(driver.counters().restarts, 2U);
}

TEST_F(LcsHeadDriver, BelievesNoOtherHead) {
  const auto lost_with = [&](auto change) {
    const CameraStatus own = head.status;
    change(head.status);
    begin(plan);
    expect_lost(Status::kBadVersion);
    head.status = own;
  };
  lost_with([](CameraStatus& status) { ++status.serial; });
  lost_with([](CameraStatus& status) { status.device = Device::kLidar; });
  lost_with([](CameraStatus& status) { ++status.version; });
}

TEST_F(LcsHeadDriver, WaitsForAStatusThatIsWhole) {
  begin(plan);
  head.measure(plan, 10);
  reinterpret_cast<std::uint8_t*>(&memory.status)[7] ^= 1;
  EXPECT_EQ(poll().count, 0U);
  EXPECT_EQ(driver.counters().damaged_frames, 1U);
  memory.status.store(encode(0, ScanEnd{}));
  EXPECT_EQ(poll().count, 0U);
  EXPECT_EQ(driver.counters().damaged_frames, 2U);
  head.say(true);
  EXPECT_EQ(poll().count, 10U);
}

TEST_F(LcsHeadDriver, SamplesWhoseTimeCannotBeMakeNoStatement) {
  begin(plan);
  head.measure(plan, plan.points);
  const auto at = [&](std::uint16_t ray) { return static_cast<std::uint32_t>(kFirstUs + pattern_time_us(plan, ray)); };
  const RawSample raw = Camera(*std::make_unique<Line>()).wall(plan, 20, 1).samples[0];
  head.record(20, raw, at(20) + kClockToleranceUs + 1);
  head.record(25, raw, at(25) - kClockToleranceUs - 1);
  head.record(30, raw, at(28));                                               // before its predecessor
  for (std::uint16_t ray = 1; ray <= 6; ++ray) head.record(ray, raw, at(0));  // the last of them 6 ms off, the others within 5
  EXPECT_TRUE(poll().complete);
  EXPECT_EQ(driver.counters().bad_times, 4U);
  for (const std::size_t ray : {6U, 20U, 25U, 30U}) {
    EXPECT_EQ(samples[ray].state, RayState::kInvalid);
    EXPECT_EQ(samples[ray].t_us, samples[ray - 1].t_us);
  }
}

TEST_F(LcsHeadDriver, CountsWhatMakesNoStatement) {
  begin(plan);
  head.measure(plan, plan.points);
  RawSample raw;
  raw.kind = SampleKind::kSaturated;
  const auto at = [&](std::uint16_t ray) { return static_cast<std::uint32_t>(kFirstUs + pattern_time_us(plan, ray)); };
  head.record(1, raw, at(1));
  raw.kind = SampleKind::kNothing;
  head.record(2, raw, at(2));
  memory.records[3][kRecordBytes - 1] = 0xF0;  // no kind that is known
  EXPECT_TRUE(poll().complete);
  EXPECT_EQ(samples[1].state, RayState::kInvalid);
  EXPECT_EQ(samples[2].state, RayState::kMiss);
  EXPECT_EQ(samples[3].state, RayState::kInvalid);
  EXPECT_EQ(driver.counters().samples_refused, 2U);
  EXPECT_EQ(driver.counters().samples_outside, 0U);
}

TEST_F(LcsHeadDriver, AScanOfAnotherPatternIsLost) {
  plan = small_plan(0x301, 100);
  std::uint32_t looks = 0;
  for (const auto& [x, y] : {std::pair{0.05, 0.0}, {-0.05, 0.0}, {0.0, 0.05}, {0.0, -0.05}}) {
    begin(plan);
    ScanPlan other = plan;
    other.center_x += x;
    other.center_y += y;
    head.measure(other, other.points);
    EXPECT_EQ(poll().status, Status::kOffPlan);
    EXPECT_EQ(driver.counters().off_plan, looks += kOffPlanFrames);
    EXPECT_EQ(poll().status, Status::kNoData);
  }
}

TEST_F(LcsHeadDriver, HandsOverNoMoreThanThereIsRoomFor) {
  begin(plan);
  head.measure(plan, plan.points);
  head.say(false);
  const SensorPoll some = driver.poll(kLaterUs, {out, 7});
  EXPECT_EQ(some.count, 7U);
  EXPECT_FALSE(some.complete);
  const SensorPoll rest = poll();
  EXPECT_EQ(rest.count, plan.points - 7U);
  EXPECT_TRUE(rest.complete);
}

TEST_F(LcsHeadDriver, GoesByTheCalibrationThatItIsGiven) {
  VERIFIES("LASSO-LCS-007~2");
  Calibration other = calibration();
  other.depth_max_m = kDepthM / 1.1;  // the wall is beside it
  driver.use_calibration(&other);
  begin(plan);
  head.measure(plan, plan.points);
  EXPECT_TRUE(poll().complete);
  EXPECT_GT(driver.counters().samples_outside, 30U);
  const std::uint32_t outside = driver.counters().samples_outside;
  driver.use_calibration(nullptr);
  begin(plan);
  head.measure(plan, plan.points);
  EXPECT_TRUE(poll().complete);
  EXPECT_EQ(driver.counters().samples_outside, outside);
}

TEST_F(LcsHeadDriver, ItsTemperatureIsThatOfTheScansBegin) {
  begin(plan);
  head.measure(plan, 10);
  poll();
  head.status.temperature_degC = 40;
  head.say(true);
  head.measure(plan, plan.points);
  EXPECT_TRUE(poll().complete);
  for (const RangeSample& sample : samples) EXPECT_NEAR(static_cast<double>(sample.range_m * sample.direction[2]), kDepthM, 2e-5);
}

TEST(LcsHeadDriverDeath, CalibrationThatIsNotValid) {
  Calibration bad = calibration();
  bad.baseline_m = 0;
  HeadMemory memory;
  EXPECT_DEATH(HeadDriver(memory, Optics(bad)), "lcs calibration");
}

TEST(SharedFrame, IsWholeOrNone) {
  SharedFrame shared;
  Frame frame;
  EXPECT_FALSE(shared.load(frame)) << "nothing was stored";
  const FrameBytes sent = encode(7, CameraStatus{});
  shared.store(sent);
  ASSERT_TRUE(shared.load(frame));
  EXPECT_EQ(frame.sequence, 7);
  FrameBytes half = encode(8, CameraStatus{});
  half.size /= 2;
  shared.store(half);
  EXPECT_FALSE(shared.load(frame)) << "half of it is the one before";
}

TEST(SharedWord, HasItsHighestByteFirst) {
  VERIFIES("LASSO-LCS-022~1");
  SharedWord word;
  word.store(0x12345678);
  std::uint8_t bytes[4];
  std::memcpy(bytes, &word, sizeof bytes);
  EXPECT_EQ(bytes[0], 0x12);
  EXPECT_EQ(bytes[3], 0x78);
  EXPECT_EQ(word.load(), 0x12345678U);
}

}  // namespace
}  // namespace lasso::lcs
