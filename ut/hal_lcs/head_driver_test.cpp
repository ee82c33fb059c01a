// The driver of a head at memory: a scan from its plan to its points.
#include "hal_lcs/head_driver.hpp"

#include <cstring>

#include "ut/hal_lcs/head_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

TEST_F(LcsHeadDriver, BringsAScanFromPlanToPoints) {
  VERIFIES("LASSO-LCS-022~2");
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
  VERIFIES("LASSO-LCS-022~2");
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
  VERIFIES("LASSO-LCS-022~2");
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

}  // namespace
}  // namespace lasso::lcs
