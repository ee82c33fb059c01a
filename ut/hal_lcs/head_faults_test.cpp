// What a head at memory may say wrongly, late or not at all.
#include <algorithm>
#include <vector>

#include "ut/hal_lcs/head_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

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
  VERIFIES("LASSO-LCS-022~2");
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

}  // namespace
}  // namespace lasso::lcs
