#include "fsw/exec/scan_faults.hpp"

#include <cmath>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

ScanPlan plan_of(double half_x, double half_y) {
  ScanPlan plan;
  plan.points = 200;
  plan.half_x = half_x;
  plan.half_y = half_y;
  return plan;
}

// A whole scan, its rays spread over `half_x` and `half_y` about a generic centre.
RangeImage image_of(double half_x, double half_y, std::size_t rays = 200) {
  test::Generator generator(7);
  RangeImage image;
  for (std::size_t i = 0; i < rays; ++i) {
    const double x = 0.11 + half_x * generator.uniform(-1, 1);
    const double y = -0.07 + half_y * generator.uniform(-1, 1);
    const double length = std::sqrt(1 + x * x + y * y);
    RangeSample sample;
    sample.direction[0] = static_cast<float>(x / length);
    sample.direction[1] = static_cast<float>(y / length);
    sample.direction[2] = static_cast<float>(1 / length);
    sample.state = i % 3 == 0 ? RayState::kMiss : RayState::kHit;
    EXPECT_TRUE(image.samples.push_back(sample));
  }
  return image;
}

ScanVerdict whole() {
  ScanVerdict verdict;
  verdict.complete = true;
  verdict.usable = true;
  verdict.reason = Status::kOk;
  verdict.count = 200;
  verdict.hits = 120;
  verdict.misses = 80;
  return verdict;
}

ScanVerdict lost(ScanLoss loss, std::uint16_t count, Status reason = Status::kNoData) {
  ScanVerdict verdict;
  verdict.reason = reason;
  verdict.loss = loss;
  verdict.count = count;
  return verdict;
}

std::uint32_t bits_of(std::initializer_list<Fault> faults) {
  FaultSet set;
  for (const Fault fault : faults) set.add(fault);
  return set.bits();
}

std::uint32_t found(const ScanVerdict& verdict) { return scan_faults(verdict).bits(); }

TEST(ScanFaults, AWholeScanHasNone) {
  VERIFIES("LASSO-HLT-001~1");
  EXPECT_EQ(found(whole()), 0u);
}

TEST(ScanFaults, FollowWhatTheScanWasLostFor) {
  VERIFIES("LASSO-HLT-001~1");
  using L = ScanLoss;
  const struct {
    ScanLoss loss;
    std::uint32_t faults;
  } kTable[] = {{L::kInhibited, 0},
                {L::kNoRoom, 0},
                {L::kSilent, bits_of({Fault::kSensorSilent})},
                {L::kBusy, bits_of({Fault::kSensorLate})},
                {L::kRefused, 0},
                {L::kRestarted, bits_of({Fault::kScanIncomplete})},
                {L::kForeign, bits_of({Fault::kSensorCorrupt})},
                {L::kStopped, bits_of({Fault::kScanIncomplete})},
                {L::kOffPlan, bits_of({Fault::kSensorCorrupt})},
                {L::kOther, bits_of({Fault::kSensorCorrupt})},
                {L::kUnfinished, bits_of({Fault::kScanIncomplete})},
                {L::kThin, bits_of({Fault::kScanIncomplete})},
                {L::kStuck, bits_of({Fault::kSensorStuck})},
                {L::kFrozen, bits_of({Fault::kSensorCorrupt})}};
  for (const auto& row : kTable) EXPECT_EQ(found(lost(row.loss, 40)), row.faults) << static_cast<int>(row.loss);
}

TEST(ScanFaults, ASensorThatIsUnfinishedIsLateOrSilent) {
  VERIFIES("LASSO-HLT-001~1");
  EXPECT_EQ(found(lost(ScanLoss::kUnfinished, 40, Status::kTimeout)), bits_of({Fault::kSensorLate, Fault::kScanIncomplete}));
  EXPECT_EQ(found(lost(ScanLoss::kUnfinished, 0, Status::kTimeout)), bits_of({Fault::kSensorSilent}));
}

TEST(ScanFaults, AScanThatEndsLateIsLateEvenIfItIsUsed) {
  VERIFIES("LASSO-HLT-001~1");
  ScanVerdict verdict = whole();
  verdict.complete = false;
  verdict.reason = Status::kTimeout;
  verdict.count = 180;
  EXPECT_EQ(found(verdict), bits_of({Fault::kSensorLate}));
}

TEST(ScanFaults, CountWhatCannotBe) {
  VERIFIES("LASSO-HLT-001~1");
  ScanVerdict verdict = whole();
  verdict.bad[static_cast<std::size_t>(BadSample::kDirection)] = 6;
  verdict.lost = 4;
  verdict.invalid = 10;
  EXPECT_EQ(found(verdict), 0u) << "a twentieth, not more";
  verdict.lost = 5;
  verdict.invalid = 11;
  EXPECT_EQ(found(verdict), bits_of({Fault::kSensorCorrupt}));
}

TEST(ScanFaults, ASaturatedDetectorSaysNothingOfMostRays) {
  VERIFIES("LASSO-HLT-001~1");
  ScanVerdict verdict = whole();
  verdict.invalid = 100;
  EXPECT_EQ(found(verdict), 0u);
  verdict.invalid = 101;
  EXPECT_EQ(found(verdict), bits_of({Fault::kSensorSaturated}));
  verdict.lost = 101;
  EXPECT_EQ(found(verdict), bits_of({Fault::kSensorCorrupt})) << "lost on the way is not saturated";
}

// Samples that never came are no rays of the image: then more are damaged than invalid.
TEST(ScanFaults, WhatWasDamagedBeyondTheInvalidIsNotSaturated) {
  VERIFIES("LASSO-HLT-001~1");
  ScanVerdict verdict = whole();
  verdict.lost = 4;
  for (const std::uint16_t invalid : {std::uint16_t{0}, std::uint16_t{3}, std::uint16_t{104}}) {
    verdict.invalid = invalid;
    EXPECT_EQ(found(verdict), 0u) << invalid;
  }
  verdict.invalid = 105;
  EXPECT_EQ(found(verdict), bits_of({Fault::kSensorSaturated}));
}

TEST(ScanFaults, AMirrorThatStandsStillIsStuckOnEitherAxis) {
  VERIFIES("LASSO-HLT-001~1");
  const auto stuck = [](const RangeImage& image) { return mirrors_stuck(plan_of(0.2, 0.1), image); };
  EXPECT_FALSE(stuck(image_of(0.2, 0.1)));
  EXPECT_TRUE(stuck(image_of(0.2, 0.001)));
  EXPECT_TRUE(stuck(image_of(0.001, 0.1)));
  EXPECT_FALSE(stuck(image_of(0.2, 0.04)));
  EXPECT_FALSE(stuck(image_of(0.001, 0.001, 31))) << "too few rays to tell";
  RangeImage invalid = image_of(0.2, 0.001);
  for (RangeSample& sample : invalid.samples) sample.state = RayState::kInvalid;
  EXPECT_FALSE(stuck(invalid)) << "no ray says where it went";
}

// A scan of the plan, its ranges drawn by the seed.
RangeImage scan_of(const ScanPlan& plan, std::uint64_t seed) {
  test::Generator generator(seed);
  RangeImage image;
  for (std::uint16_t i = 0; i < plan.points; ++i) {
    const Vec3 u = pattern_direction(plan, i);
    RangeSample sample;
    for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(u[k]);
    sample.range_m = static_cast<float>(generator.uniform(2, 3));
    sample.t_us = i;
    sample.state = RayState::kHit;
    EXPECT_TRUE(image.samples.push_back(sample));
  }
  return image;
}

class RepeatedScan : public ::testing::Test {
 protected:
  ScanPlan turned(double phase_turns) const {
    ScanPlan plan = plan_;
    plan.phase_turns = phase_turns;
    return plan;
  }
  bool repeated(const ScanPlan& next, const RangeImage& image) const { return is_repeated(trace_of(plan_, scan_), trace_of(next, image)); }
  ScanPlan plan_ = plan_of(0.2, 0.1);
  RangeImage scan_ = scan_of(plan_, 3);
};

TEST_F(RepeatedScan, IsToldByItsSamplesWhereItsPlanIsAnother) {
  VERIFIES("LASSO-MOD-181~3");
  EXPECT_TRUE(repeated(turned(0.38), scan_));
  RangeImage later = scan_;
  later.scan_id = 7;
  for (RangeSample& sample : later.samples) sample.t_us += 200000;
  EXPECT_TRUE(repeated(turned(0.38), later)) << "whatever its times and number say";
  EXPECT_FALSE(repeated(plan_, later)) << "nothing can be told: without noise a target at rest looks like this";
  EXPECT_FALSE(repeated(turned(0.38), scan_of(turned(0.38), 3)));
}

TEST_F(RepeatedScan, IsTheSameInEachBit) {
  VERIFIES("LASSO-MOD-181~3");
  for (const std::size_t changed : {std::size_t{0}, std::size_t{117}, std::size_t{199}}) {
    RangeImage other = scan_;
    other.samples[changed].range_m = std::nextafter(other.samples[changed].range_m, 9.0F);
    EXPECT_FALSE(repeated(turned(0.38), other)) << changed;
    other = scan_;
    other.samples[changed].direction[1] = std::nextafter(other.samples[changed].direction[1], 9.0F);
    EXPECT_FALSE(repeated(turned(0.38), other)) << changed;
  }
}

// Each way alone in which the next plan's rays can lie elsewhere.
TEST_F(RepeatedScan, APlanIsAnotherWhereItsRaysAre) {
  VERIFIES("LASSO-MOD-181~3");
  for (const double offset : {0.01, -0.01}) {
    ScanPlan next = plan_;
    next.center_x += offset;
    EXPECT_TRUE(repeated(next, scan_)) << offset;
    next = plan_;
    next.center_y += offset;
    EXPECT_TRUE(repeated(next, scan_)) << offset;
  }
  ScanPlan next = plan_;
  next.center_x += 1e-5;
  EXPECT_FALSE(repeated(next, scan_)) << "no mirror resolves that";
  next = plan_;
  next.duration_us += 1000;
  EXPECT_FALSE(repeated(next, scan_));
  std::vector<AimedRay> aimed(60, AimedRay{0.02F, -0.03F});
  next = plan_;
  next.aimed = Span<const AimedRay>(aimed.data(), aimed.size());
  EXPECT_TRUE(repeated(next, scan_));
}

TEST_F(RepeatedScan, FewRaysDoNotTell) {
  VERIFIES("LASSO-MOD-181~3");
  for (std::size_t i = kRaysToTell; i < scan_.samples.size(); ++i) scan_.samples[i] = RangeSample{};  // invalid
  EXPECT_TRUE(repeated(turned(0.38), scan_));
  scan_.samples[0] = RangeSample{};
  EXPECT_FALSE(repeated(turned(0.38), scan_));
  EXPECT_FALSE(is_repeated(ScanTrace(), trace_of(plan_, scan_of(plan_, 5)))) << "the first one";
}

}  // namespace
}  // namespace lasso
