#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "hal_lcs/driver.hpp"
#include "ut/hal_lcs/driver_fixture.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

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
  VERIFIES("LASSO-LCS-015~2");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  camera.status(1, kSerial + 1);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(lost(Loss::kForeign), 1U);
}

TEST_F(LcsDriver, ACameraThatHasNotSaidWhichItIsGivesNoPoint) {
  VERIFIES("LASSO-LCS-015~2");
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

TEST_F(LcsDriver, AScanThatTheCameraEndsIsLost) {
  VERIFIES("LASSO-LCS-012~1");
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
    EXPECT_EQ(poll().status, Status::kOffPlan);
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
  EXPECT_EQ(fate(Fate::kNoStatement), 1U);
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

// Whether it is lost is for the acquisition to say, which may use what is there.
TEST_F(LcsDriver, AnAbortedScanIsToldTheCamera) {
  VERIFIES("LASSO-LCS-012~1");
  begin(small_plan());
  poll();
  driver.abort();
  EXPECT_EQ(camera.heard().back().type, static_cast<std::uint8_t>(Type::kAbort));
  driver.abort();
  EXPECT_TRUE(camera.heard().empty());
  camera.status();  // in no scan: heard, no more
  EXPECT_EQ(poll().status, Status::kNoData);
  begin(small_plan());
  const std::vector<std::uint8_t> block(kLineBytes, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  driver.abort();
  for (const std::uint32_t count : driver.health().scans_lost) EXPECT_EQ(count, 0U);
}

TEST_F(LcsDriver, AFrameThatComesAgainIsNoGap) {
  VERIFIES("LASSO-LCS-014~2");
  const ScanPlan plan = small_plan();
  begin(plan);
  camera.say(camera.wall(plan, 0));
  --camera.sequence;
  camera.say(camera.wall(plan, 0));
  camera.say(camera.wall(plan, 4));
  poll();
  EXPECT_EQ(driver.health().repeated, 1U);
  EXPECT_EQ(driver.health().sequence_gaps, 0U);
  EXPECT_EQ(samples.size(), 8U);
  EXPECT_EQ(driver.health().strayed, 4U);
}

TEST_F(LcsDriver, AnotherKindOfHeadIsNotBelieved) {
  VERIFIES("LASSO-LCS-015~2");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  CameraStatus status;
  status.serial = kSerial;
  status.device = Device::kTridar;
  camera.say(status);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(lost(Loss::kForeign), 1U);
}

TEST_F(LcsDriver, AnotherProtocolIsNotBelieved) {
  VERIFIES("LASSO-LCS-015~2");
  ASSERT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  CameraStatus status;
  status.serial = kSerial;
  status.version = kProtocolVersion + 1;
  camera.say(status);
  camera.answer(camera.heard());
  EXPECT_EQ(poll().status, Status::kBadVersion);
  EXPECT_EQ(lost(Loss::kForeign), 1U);
}

TEST_F(LcsDriver, ItsCountersAreWhatTelemetrySays) {
  VERIFIES("LASSO-LCS-012~1");
  const ScanPlan plan = small_plan();
  begin(plan);
  Samples bad = camera.wall(plan, 0);
  bad.samples[0].kind = SampleKind::kSaturated;
  bad.samples[1].angle_y_rad = 0.5;
  bad.samples[2].peak = -1;
  bad.samples[3].peak = 0.9;
  camera.say(bad);
  ++camera.sequence;
  Samples late = camera.wall(plan, 8);
  late.samples[3].clock_us += 60'000;
  late.samples[0].angle_x_rad += 0.05;
  camera.say(late);
  camera.say(late);
  --camera.sequence;
  camera.say(Type::kAbort);
  const std::uint8_t garbage[] = {0x5A, 0xC3, 200, 1, 2, 3};
  line.from_camera.write(ConstBytes(garbage));
  FrameBytes damaged = encode(camera.sequence++, ScanEnd{tag_of(plan.scan_id), 40, true});
  damaged.bytes[6] ^= 1;
  line.from_camera.write(damaged.span());
  camera.status();
  poll();
  const SensorCounters counters = driver.counters();
  EXPECT_EQ(counters.frames, 7U) << "status, answer, three of samples, what is not defined, status";
  EXPECT_EQ(counters.damaged_frames, driver.line_counters().bad_crc + driver.line_counters().bad_length);
  EXPECT_GE(counters.damaged_frames, 2U);
  EXPECT_EQ(counters.missing_frames, 2U);
  EXPECT_EQ(counters.repeated_frames, 1U);
  EXPECT_EQ(counters.unknown_frames, 1U);
  EXPECT_EQ(counters.strayed, 4U);
  EXPECT_EQ(counters.samples_lost, 4U);
  EXPECT_EQ(counters.samples_refused, 4U);
  EXPECT_EQ(counters.bad_times, 1U);
  EXPECT_EQ(counters.off_plan, 1U);
  EXPECT_EQ(counters.clock_jumps, 0U);
  EXPECT_EQ(counters.restarts, 0U);
}

TEST_F(LcsDriver, BabbleIsReadWithinTheBound) {
  VERIFIES("LASSO-LCS-004~1");
  const ScanPlan plan = small_plan();
  begin(plan);
  poll();
  test::Generator chance(77);
  std::vector<std::uint8_t> babble(kLineBytes);
  // Syncs, right and wrong lengths, types, anything: so that all ways through the decoder are taken.
  for (std::uint8_t& byte : babble) {
    const std::uint8_t usual[] = {0x5A, 0xC3, 4, 57, 58, 0x91, static_cast<std::uint8_t>(chance.bits())};
    byte = usual[chance.below(7)];
  }
  line.from_camera.write(ConstBytes(babble.data(), babble.size()));
  EXPECT_EQ(poll().status, Status::kOk);
  EXPECT_EQ(line.from_camera.room(), kLineBytes);
  EXPECT_GT(driver.line_counters().skipped, kLineBytes - 2 * kMaxFrame);
  EXPECT_GT(driver.line_counters().bad_crc, 10U);
  EXPECT_GT(driver.line_counters().bad_length, 10U);
  for (int i = 0; i < 3; ++i) camera.say(Type::kAbort);  // fills what a false beginning waits for
  camera.say(camera.wall(plan, 0));
  poll();
  EXPECT_EQ(samples.size(), 4U);
}

}  // namespace
}  // namespace lasso::lcs
