#include "fsw/exec/scan_faults.hpp"

#include <cmath>

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
                {L::kStuck, bits_of({Fault::kSensorStuck})}};
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

}  // namespace
}  // namespace lasso
