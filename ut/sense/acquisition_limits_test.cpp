// Which samples are not believed, and for which reason.
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "ut/sense/acquisition_fixture.hpp"

namespace lasso {
namespace {

using test::kStart;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class BadSamplesTest : public test::AcquisitionTest {
 protected:
  // Why a scan whose sample 500 is this one does not believe it.
  std::optional<BadSample> reason_of(const RangeSample& sample) {
    const RangeSample replaced = sensor.samples[500];
    sensor.samples[500] = sample;
    const ScanVerdict verdict = run();
    sensor.samples[500] = replaced;
    std::optional<BadSample> reason;
    std::uint32_t bad = 0;
    for (std::size_t kind = 0; kind < kBadSampleKinds; ++kind) {
      bad += verdict.bad[kind];
      if (verdict.bad[kind] > 0) reason = static_cast<BadSample>(kind);
    }
    EXPECT_EQ(bad, reason ? 1U : 0U) << "no other sample is";
    EXPECT_EQ(image->samples[500].state, reason ? RayState::kInvalid : sample.state);
    return reason;
  }
  // Sample 500 as a hit straight ahead.
  RangeSample good_hit() const {
    RangeSample hit = sensor.samples[500];
    hit.state = RayState::kHit;
    hit.range_m = 3;
    hit.direction[0] = hit.direction[1] = 0;
    hit.direction[2] = 1;
    return hit;
  }
};

TEST_F(BadSamplesTest, BadSamplesBecomeInvalidAndAreCountedByReason) {
  VERIFIES("LASSO-SNS-022~3 LASSO-SYS-011~2");
  std::vector<RangeSample>& s = sensor.samples;
  for (const std::size_t i : {14u, 15u, 20u, 21u, 22u}) s[i].state = RayState::kHit;
  s[10].direction[1] = kNan;
  s[11].range_m = kInfinity;
  s[12].direction[2] *= 1.003F;
  s[13].direction[2] *= 0.997F;
  s[14].range_m = -0.001F;
  s[15].range_m = 1.01e5F;
  s[16].t_us = s[15].t_us - 2000;
  s[17].t_us = kStart + 200001;
  s[18].state = static_cast<RayState>(4);
  s[20].sigma_factor = 0.99F;
  s[21].sigma_factor = kNan;
  s[22].sigma_factor = 10.1F;
  s[1023].t_us = kStart;
  sensor.ignores_time = true;
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kNotFinite)], 3u);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kDirection)], 2u);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kRange)], 4u);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kTime)], 3u);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kState)], 1u);
  EXPECT_EQ(verdict.invalid, 13);
  EXPECT_EQ(verdict.count, 1024);
  EXPECT_TRUE(verdict.usable);
  for (const std::size_t i : {10u, 11u, 12u, 13u, 14u, 15u, 16u, 17u, 18u, 20u, 21u, 22u, 1023u}) {
    EXPECT_EQ(image->samples[i].state, RayState::kInvalid) << i;
    EXPECT_EQ(image->samples[i].range_m, 0) << i;
    EXPECT_EQ(image->samples[i].direction[2], 1) << i;
    EXPECT_EQ(image->samples[i].t_us, image->samples[i - 1].t_us) << i;
  }
  EXPECT_EQ(image->samples[19].t_us, s[19].t_us) << "a bad sample does not spoil the next one";
  EXPECT_EQ(image->samples[19].state, s[19].state);
}

TEST_F(BadSamplesTest, DirectionsMayBeOffUnitLengthByTheirTolerance) {
  VERIFIES("LASSO-SNS-022~3");
  const auto reason_at = [&](double squared_length) {
    RangeSample hit = good_hit();
    hit.direction[2] = static_cast<float>(std::sqrt(squared_length));
    return reason_of(hit);
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(reason_at(1 + side * 2e-3 * (1 - 1e-3)), std::nullopt) << side;
    EXPECT_EQ(reason_at(1 + side * 2e-3 * (1 + 1e-3)), BadSample::kDirection) << side;
  }
}

TEST_F(BadSamplesTest, RangesAndFactorsOfHitsHaveLimits) {
  VERIFIES("LASSO-SNS-022~3");
  const auto reason_with = [&](float range_m, float factor, RayState state = RayState::kHit) {
    RangeSample sample = good_hit();
    sample.range_m = range_m;
    sample.sigma_factor = factor;
    sample.state = state;
    return reason_of(sample);
  };
  EXPECT_EQ(reason_with(1e5F, 1), std::nullopt);
  EXPECT_EQ(reason_with(std::nextafter(1e5F, kInfinity), 1), BadSample::kRange);
  EXPECT_EQ(reason_with(0, 1), std::nullopt);
  EXPECT_EQ(reason_with(-std::numeric_limits<float>::min(), 1), BadSample::kRange);
  EXPECT_EQ(reason_with(3, std::nextafter(1.0F, 0.0F)), BadSample::kRange);
  EXPECT_EQ(reason_with(3, 10), std::nullopt);
  EXPECT_EQ(reason_with(3, std::nextafter(10.0F, kInfinity)), BadSample::kRange);
  EXPECT_EQ(reason_with(2e5F, 20, RayState::kMiss), std::nullopt) << "a miss has neither";
  EXPECT_EQ(reason_with(kNan, 1, RayState::kMiss), BadSample::kNotFinite);
  EXPECT_EQ(reason_with(3, kInfinity, RayState::kMiss), BadSample::kNotFinite);
}

TEST_F(BadSamplesTest, TimesLieBetweenTheLastAcceptedSampleAndThePresent) {
  VERIFIES("LASSO-SNS-022~3");
  const auto reason_at = [&](TimeUs t_us, RayState state = RayState::kHit) {
    RangeSample sample = good_hit();
    sample.t_us = t_us;
    sample.state = state;
    return reason_of(sample);
  };
  sensor.ignores_time = true;
  const TimeUs last_us = sensor.samples[499].t_us;
  EXPECT_EQ(reason_at(last_us - 1), BadSample::kTime);
  EXPECT_EQ(reason_at(last_us), std::nullopt);
  EXPECT_EQ(reason_at(last_us - 1, RayState::kInvalid), BadSample::kTime) << "also of one that the sensor declares invalid";
  sensor.samples[499].direction[2] = kNan;
  sensor.samples.erase(sensor.samples.begin() + 501, sensor.samples.end());
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kNotFinite)], 1U);
  sensor.samples[500].t_us = sensor.samples[498].t_us;  // before the sample that was not accepted
  EXPECT_EQ(run().bad[static_cast<int>(BadSample::kTime)], 0U);
  sensor.samples[500].t_us = sensor.samples[498].t_us - 1;
  EXPECT_EQ(run().bad[static_cast<int>(BadSample::kTime)], 1U);
  constexpr TimeUs kNow = kStart + 200000;
  sensor.samples[500].t_us = kNow;
  EXPECT_EQ(run(100, kNow).bad[static_cast<int>(BadSample::kTime)], 0U);
  sensor.samples[500].t_us = kNow + 1;
  EXPECT_EQ(run(100, kNow).bad[static_cast<int>(BadSample::kTime)], 1U);
}

// In the order of the requirement, from the last one to the first.
TEST_F(BadSamplesTest, TheFirstReasonThatHoldsIsCounted) {
  VERIFIES("LASSO-SNS-022~3");
  RangeSample sample = good_hit();
  sample.range_m = -1;
  EXPECT_EQ(reason_of(sample), BadSample::kRange);
  sample.direction[2] = 2;
  EXPECT_EQ(reason_of(sample), BadSample::kDirection);
  sample.range_m = kNan;
  EXPECT_EQ(reason_of(sample), BadSample::kNotFinite);
  RangeSample declared = sample;
  declared.state = RayState::kInvalid;
  EXPECT_EQ(reason_of(declared), std::nullopt) << "it says nothing that could be wrong";
  sample.t_us = kStart - 1;
  EXPECT_EQ(reason_of(sample), BadSample::kTime);
  sample.state = static_cast<RayState>(4);
  EXPECT_EQ(reason_of(sample), BadSample::kState);
}

// Farther from the scan's middle than points can be moved to it: 100 s, or what the fixed-point type holds.
TEST_F(BadSamplesTest, SamplesLaterThanTheLongestScanAreBad) {
  VERIFIES("LASSO-SNS-022~3");
  constexpr DurationUs kLongest_us = std::is_same_v<FlightNumber, FloatNumber> ? 100'000'000 : 3'800'000;
  sensor.ignores_time = true;
  sensor.samples[1022].t_us = kStart + kLongest_us;
  sensor.samples[1023].t_us = kStart + kLongest_us + 1;
  const ScanVerdict verdict = run(100, kStart + 2 * kLongest_us);
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kTime)], 1U);
  EXPECT_EQ(image->samples[1022].t_us, kStart + kLongest_us);
  EXPECT_EQ(image->samples[1023].state, RayState::kInvalid);
  EXPECT_EQ(image->samples[1023].t_us, image->samples[1022].t_us);
}

TEST_F(BadSamplesTest, SamplesBeforeTheStartAreBad) {
  VERIFIES("LASSO-SNS-022~3");
  sensor.samples[0].t_us = kStart - 1;
  const ScanVerdict verdict = run();
  EXPECT_EQ(verdict.bad[static_cast<int>(BadSample::kTime)], 1u);
  EXPECT_EQ(image->samples[0].t_us, kStart);
}

}  // namespace
}  // namespace lasso
