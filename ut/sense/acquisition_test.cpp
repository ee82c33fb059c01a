#include "fsw/sense/acquisition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "ut/sense/acquisition_fixture.hpp"

namespace lasso {
namespace {

using test::AcquisitionTest;
using test::kStart;

TEST_F(AcquisitionTest, ASensorWithoutALaserScansWhateverIsPermitted) {
  VERIFIES("LASSO-SNS-020~1");
  Sensor& without_laser = sensor;
  without_laser.permit_laser(false);
  EXPECT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kOk);
  EXPECT_EQ(without_laser.counters().frames, 0u) << "nor has it a line";
}

TEST_F(AcquisitionTest, StoresAWholeScanAsTheSensorSawIt) {
  VERIFIES("LASSO-SNS-020~1 LASSO-SNS-021~1 LASSO-SYS-023~1");
  const ScanVerdict verdict = run();
  EXPECT_TRUE(verdict.complete);
  EXPECT_TRUE(verdict.usable);
  EXPECT_EQ(verdict.reason, Status::kOk);
  EXPECT_EQ(verdict.scan_id, 42u);
  EXPECT_EQ(image->scan_id, 42u);
  EXPECT_TRUE(image->misses_known);
  ASSERT_EQ(image->samples.size(), 1024u);
  int hits = 0;
  for (std::size_t i = 0; i < image->samples.size(); ++i) {
    const RangeSample &kept = image->samples[i], &seen = sensor.samples[i];
    ASSERT_EQ(kept.state, seen.state);
    ASSERT_EQ(kept.range_m, seen.range_m);
    ASSERT_EQ(kept.t_us, seen.t_us);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(kept.direction[k], seen.direction[k], 1.2e-7);
    hits += kept.state == RayState::kHit;
  }
  EXPECT_EQ(verdict.hits, hits);
  EXPECT_EQ(verdict.misses, 1024 - hits);
  EXPECT_EQ(verdict.invalid, 0);
  EXPECT_EQ(image->reference_time_us(), kStart + 90000);
  EXPECT_EQ(sensor.aborts, 0);
}

TEST_F(AcquisitionTest, TheImageKnowsItsAimedSamples) {
  VERIFIES("LASSO-SNS-007~1");
  const AimedRay rays[3] = {};
  plan.aimed = Span<const AimedRay>(rays);
  run();
  for (std::size_t i = 0; i < 1024; ++i) EXPECT_EQ(image->is_aimed(i), i >= 510 && i < 513);
  plan.aimed = {};
  run();
  for (std::size_t i = 0; i < 1024; ++i) EXPECT_FALSE(image->is_aimed(i));
}

TEST_F(AcquisitionTest, PollsOncePerStepAndAtMostTheCapacity) {
  VERIFIES("LASSO-SNS-021~1");
  ASSERT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kOk);
  for (std::size_t step = 1; step <= 8; ++step) {
    acquisition.step(sensor, kStart + 200000, *image);
    EXPECT_EQ(sensor.polls, static_cast<int>(step));
    EXPECT_EQ(image->samples.size(), step * kMaxSamplesPerPoll);
  }
  EXPECT_FALSE(acquisition.under_way());
  acquisition.step(sensor, kStart + 200000, *image);
  EXPECT_EQ(sensor.polls, 8) << "nothing is asked after the scan's end";
}

TEST_F(AcquisitionTest, TakesOnlyWhatHasBeenAcquiredByNow) {
  VERIFIES("LASSO-SNS-021~1");
  ASSERT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kOk);
  acquisition.step(sensor, kStart - 1, *image);
  EXPECT_EQ(image->samples.size(), 0u);
  acquisition.step(sensor, kStart + 1000, *image);
  EXPECT_EQ(image->samples.size(), 6u);  // one sample each 175.95 us
}

TEST_F(AcquisitionTest, SlightlyWrongDirectionsAreBroughtToUnitLength) {
  VERIFIES("LASSO-SNS-023~1");
  for (int i = 0; i < 100; ++i) {
    for (float& component : sensor.samples[static_cast<std::size_t>(i)].direction)
      component *= 1 + 9.9e-6F * static_cast<float>(2 * i - 100);
  }
  ASSERT_TRUE(run().usable);
  for (std::size_t i = 0; i < 100; ++i) {
    const RangeSample& kept = image->samples[i];
    ASSERT_EQ(kept.state, sensor.samples[i].state);
    const double length = std::sqrt(std::pow(kept.direction[0], 2.0) + std::pow(kept.direction[1], 2.0) + std::pow(kept.direction[2], 2.0));
    ASSERT_NEAR(length, 1, 1.5e-7) << i;
    const Vec3 ray = pattern_direction(plan, static_cast<std::uint16_t>(i));
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(kept.direction[k], ray[k], 1.5e-7);
  }
}

TEST_F(AcquisitionTest, RaysTheSensorDeclaresInvalidAreNotBadAndMissesHaveNoRange) {
  VERIFIES("LASSO-SNS-021~1");
  sensor.samples[5].state = RayState::kInvalid;
  sensor.samples[5].direction[0] = std::numeric_limits<float>::quiet_NaN();
  sensor.samples[6].state = RayState::kMiss;
  sensor.samples[6].range_m = 17;
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.invalid, 1);
  for (const std::uint32_t bad : verdict.bad) EXPECT_EQ(bad, 0u);
  EXPECT_EQ(image->samples[5].direction[0], 0);
  EXPECT_EQ(image->samples[5].t_us, sensor.samples[5].t_us);
  EXPECT_EQ(image->samples[6].range_m, 0);
}

TEST_F(AcquisitionTest, SamplesLostOnTheWayAreNotThere) {
  VERIFIES("LASSO-SNS-024~1 LASSO-LCS-002~1");
  for (std::size_t i = 0; i < 204; ++i) sensor.samples[i].state = RayState::kLost;
  const ScanVerdict usable = run();
  EXPECT_TRUE(usable.usable);
  EXPECT_EQ(usable.lost, 204);
  EXPECT_EQ(usable.invalid, 204);
  EXPECT_EQ(image->samples[203].state, RayState::kInvalid);
  for (const std::uint32_t bad : usable.bad) EXPECT_EQ(bad, 0u);
  sensor.samples[204].state = RayState::kLost;
  EXPECT_FALSE(run().usable);
}

TEST_F(AcquisitionTest, IncompleteScanIsUsableFromFourFifthsAndOtherwiseDiscarded) {
  VERIFIES("LASSO-SNS-024~1 LASSO-EXE-005~2");
  const TimeUs enough = kStart + pattern_time_us(plan, 819);  // 820 of 1024 are the first to reach 80 %
  const ScanVerdict usable = run(100, enough);
  EXPECT_FALSE(usable.complete);
  EXPECT_TRUE(usable.usable);
  EXPECT_EQ(usable.reason, Status::kTimeout);
  EXPECT_EQ(usable.count, 820);
  EXPECT_EQ(image->samples.size(), 820u);
  EXPECT_EQ(sensor.aborts, 1);
  const ScanVerdict discarded = run(100, enough - 1);
  EXPECT_FALSE(discarded.usable);
  EXPECT_EQ(discarded.reason, Status::kTimeout);
  EXPECT_EQ(discarded.count, 819);
  EXPECT_TRUE(image->samples.empty());
}

TEST_F(AcquisitionTest, CompleteScanWithTooManyBadSamplesIsDiscarded) {
  VERIFIES("LASSO-SNS-024~1");
  for (std::size_t i = 0; i < 204; ++i) sensor.samples[i].direction[0] = 3;
  EXPECT_TRUE(run().usable);
  sensor.samples[204].direction[0] = 3;
  const ScanVerdict verdict = run();
  EXPECT_TRUE(verdict.complete);
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(verdict.reason, Status::kBadValue);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kDirection)], 205u);
  EXPECT_TRUE(image->samples.empty());
}

TEST_F(AcquisitionTest, LostScanIsDiscardedWithTheSensorsReason) {
  VERIFIES("LASSO-SNS-025~1");
  sensor.lost_at = 896;  // more than 80 % of the samples have been taken by then
  sensor.lose = Status::kBadCrc;
  const ScanVerdict verdict = run();
  EXPECT_FALSE(verdict.complete);
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(verdict.reason, Status::kBadCrc);
  EXPECT_EQ(verdict.count, 896);
  EXPECT_TRUE(image->samples.empty());
  EXPECT_EQ(sensor.aborts, 1);
}

TEST_F(AcquisitionTest, EachReasonOfASensorIsACauseOfTheLoss) {
  VERIFIES("LASSO-LCS-012~1");
  const std::pair<Status, ScanLoss> causes[] = {{Status::kMissing, ScanLoss::kInhibited},  {Status::kOverCapacity, ScanLoss::kNoRoom},
                                                {Status::kTimeout, ScanLoss::kSilent},     {Status::kBusy, ScanLoss::kBusy},
                                                {Status::kBadValue, ScanLoss::kRefused},   {Status::kBadOrder, ScanLoss::kRestarted},
                                                {Status::kBadVersion, ScanLoss::kForeign}, {Status::kTruncated, ScanLoss::kStopped},
                                                {Status::kOffPlan, ScanLoss::kOffPlan},    {Status::kBadCrc, ScanLoss::kOther}};
  for (const auto& [reason, loss] : causes) {
    sensor.lost_at = 500;
    sensor.lose = reason;
    EXPECT_EQ(run().loss, loss);
    sensor.lost_at = 1u << 20;
    sensor.refuse = reason;
    static_cast<void>(acquisition.start(sensor, plan, kStart, *image));
    EXPECT_EQ(acquisition.finish(sensor, *image).loss, loss);
    sensor.refuse = Status::kOk;
    EXPECT_EQ(run().loss, ScanLoss::kNone);
  }
}

TEST_F(AcquisitionTest, AScanThatIsUsedIsNoneThatIsLost) {
  VERIFIES("LASSO-LCS-012~1");
  const TimeUs enough = kStart + pattern_time_us(plan, 819);
  EXPECT_EQ(run(100, enough).loss, ScanLoss::kNone) << "ended early, and used";
  EXPECT_EQ(run(100, enough - 1).loss, ScanLoss::kUnfinished);
  for (std::size_t i = 0; i < 205; ++i) sensor.samples[i].direction[0] = 3;
  EXPECT_EQ(run().loss, ScanLoss::kThin);
}

TEST_F(AcquisitionTest, MoreSamplesThanAskedForIsALostScan) {
  VERIFIES("LASSO-SNS-025~1");
  sensor.overclaim = true;
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.reason, Status::kBadLength);
  EXPECT_EQ(verdict.count, 0);
  EXPECT_FALSE(verdict.usable);
}

TEST_F(AcquisitionTest, WhatTheImageCannotHoldIsCounted) {
  VERIFIES("LASSO-SNS-026~1");
  const RangeSample last = sensor.samples.back();
  sensor.samples.resize(kMaxRays, last);
  EXPECT_EQ(run().overflow, 0u);
  std::vector<RangeSample> more(7, last);  // of each kind
  more[0].state = RayState::kHit;
  more[1].state = RayState::kMiss;
  more[2].state = RayState::kInvalid;
  more[3].state = RayState::kLost;
  more[4].direction[0] = 3;
  more[5].t_us = -1;
  sensor.samples.insert(sensor.samples.end(), more.begin(), more.end());
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.count, kMaxRays);
  EXPECT_EQ(image->samples.size(), kMaxRays);
  EXPECT_EQ(verdict.hits + verdict.misses + verdict.invalid, verdict.count);
  EXPECT_EQ(verdict.overflow, 7u);
  EXPECT_TRUE(verdict.complete);
  sensor.samples.resize(kMaxRays);
  EXPECT_EQ(run().overflow, 0u) << "of the scan before";
}

TEST_F(AcquisitionTest, RefusedStartsSayWhyAndLeaveNothingUnderWay) {
  VERIFIES("LASSO-SNS-020~1");
  sensor.refuse = Status::kBusy;
  EXPECT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kBusy);
  EXPECT_FALSE(acquisition.under_way());
  EXPECT_EQ(acquisition.finish(sensor, *image).reason, Status::kBusy);
  sensor.refuse = Status::kOk;
  plan.half_x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kNotFinite);
  acquisition.step(sensor, kStart + 200000, *image);
  EXPECT_EQ(sensor.polls, 0);
  const ScanVerdict verdict = acquisition.finish(sensor, *image);
  EXPECT_EQ(verdict.reason, Status::kNotFinite);
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(acquisition.finish(sensor, *image).reason, Status::kNoData) << "no scan was started since";
}

TEST_F(AcquisitionTest, ASecondStartIsRefusedAndDisturbsNothing) {
  VERIFIES("LASSO-SNS-020~1");
  ASSERT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kOk);
  acquisition.step(sensor, kStart + 200000, *image);
  ScanPlan other = plan;
  other.scan_id = 43;
  EXPECT_EQ(acquisition.start(sensor, other, kStart, *image), Status::kBusy);
  EXPECT_EQ(image->samples.size(), kMaxSamplesPerPoll);
  for (int i = 0; i < 7; ++i) acquisition.step(sensor, kStart + 200000, *image);
  const ScanVerdict verdict = acquisition.finish(sensor, *image);
  EXPECT_EQ(verdict.scan_id, 42u);
  EXPECT_EQ(verdict.reason, Status::kOk);
}

TEST_F(AcquisitionTest, AScanAfterALostOneStartsAfresh) {
  VERIFIES("LASSO-SNS-025~1");
  sensor.lost_at = 500;
  sensor.lose = Status::kTimeout;
  EXPECT_FALSE(run().usable);
  sensor.lost_at = 1u << 20;
  const ScanVerdict verdict = run();
  EXPECT_TRUE(verdict.usable);
  EXPECT_EQ(verdict.count, 1024);
  EXPECT_EQ(image->samples.size(), 1024u);
}

}  // namespace
}  // namespace lasso
