#include <limits>
#include <string>
#include <utility>

#include "ut/pose/bearing_fixture.hpp"

namespace lasso {
namespace {

using test::BearingTest;
using test::kPeriodUs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(BearingTest, AScanWithoutATargetSaysWhy) {
  VERIFIES("LASSO-MOD-104~1");
  RangeImage& image = scan(0);
  for (RangeSample& sample : image.samples) sample.state = RayState::kMiss;
  expect_refused(BearingReason::kNothingSeen, image);
  RangeImage& wall = scan(1);
  for (RangeSample& sample : wall.samples) sample.state = RayState::kMiss;
  add_wall(40, wall);
  expect_refused(BearingReason::kOnlyBackground, wall);
  RangeImage& empty = scan(2);
  empty.samples.clear();
  expect_refused(BearingReason::kNoScan, empty);
}

TEST_F(BearingTest, TooFewReturnsAreNoBearing) {
  VERIFIES("LASSO-MOD-104~1");
  mission_.parameters.bearing_returns_min = 40;
  const auto leave = [](int count, RangeImage& image) -> RangeImage& {
    for (RangeSample& sample : image.samples) {
      if (sample.state == RayState::kHit && count-- <= 0) sample.state = RayState::kMiss;
    }
    return image;
  };
  expect_refused(BearingReason::kTooFewReturns, leave(39, scan(0)));
  RangeImage& image = leave(39, scan(1));
  int strays = 10;  // enough returns, but not of one target
  for (RangeSample& sample : image.samples) {
    if (sample.state == RayState::kHit || strays-- <= 0) continue;
    sample.state = RayState::kHit;
    sample.range_m = 95;
  }
  expect_refused(BearingReason::kTooFewReturns, image);
  EXPECT_TRUE(find(leave(40, scan(2))).valid());
}

// What no ray of this sensor can have measured does not count; where nothing else is left, its kind is the reason.
TEST_F(BearingTest, ReturnsThatCannotBeAreNotBelieved) {
  VERIFIES("LASSO-MOD-104~1 LASSO-MOD-102~2");
  ASSERT_TRUE(find(0).valid());
  using Spoil = void (*)(RangeSample&);
  const struct {
    BearingReason reason;
    Spoil spoil;
  } cases[] = {
      {BearingReason::kNotFinite, [](RangeSample& s) { s.range_m = static_cast<float>(kNan); }},
      {BearingReason::kNotFinite, [](RangeSample& s) { s.direction[1] = static_cast<float>(kNan); }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[2] = -s.direction[2]; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[0] = 0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[0] = -0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[1] = 0.3f; }},
      {BearingReason::kOutsideField, [](RangeSample& s) { s.direction[1] = -0.3f; }},
      {BearingReason::kOutsideRange, [](RangeSample& s) { s.range_m = 0.99f; }},
      {BearingReason::kOutsideRange, [](RangeSample& s) { s.range_m = 100.1f; }},
  };
  std::uint32_t k = 1;
  for (const auto& c : cases) {
    RangeImage& all = scan(k++);
    for (RangeSample& sample : all.samples) {
      if (sample.state == RayState::kHit) c.spoil(sample);
    }
    expect_refused(c.reason, all);
    RangeImage& half = scan(k++);  // the other half is enough
    int index = 0;
    for (RangeSample& sample : half.samples) {
      if (sample.state == RayState::kHit && index++ % 2 == 0) c.spoil(sample);
    }
    const Bearing bearing = find(half);
    EXPECT_TRUE(bearing.valid()) << to_string(bearing.reason);
    EXPECT_EQ(bearing.credible, bearing.returns / 2);
  }
}

TEST_F(BearingTest, AllReturnsAtOnePointAreNoTarget) {
  VERIFIES("LASSO-MOD-104~1");
  RangeImage& image = scan(0);
  for (RangeSample& sample : image.samples) {
    sample.state = RayState::kHit;
    sample.direction[0] = 0.1f;
    sample.direction[1] = -0.05f;
    sample.direction[2] = 0.99373f;
    sample.range_m = 20;
  }
  expect_refused(BearingReason::kOneDirection, image);
  for (const int axis : {0, 1}) {  // spread in either direction is spread, on either side
    for (const float step : {1e-4f, -1e-4f}) {
      RangeImage& line = scan(axis == 0 ? 1 : 2);
      int index = 0;
      for (RangeSample& sample : line.samples) {
        sample.state = RayState::kHit;
        sample.direction[0] = 0.05f;
        sample.direction[1] = 0.05f;
        sample.direction[2] = 0.9975f;
        sample.direction[axis] += step * static_cast<float>(++index % 100);
        sample.range_m = 20;
      }
      state_ = BearingState{};
      EXPECT_TRUE(find(line).valid());
    }
  }
}

TEST_F(BearingTest, TimeThatGoesBackIsRefused) {
  VERIFIES("LASSO-MOD-104~1");
  ASSERT_TRUE(find(5).valid());
  expect_refused(BearingReason::kSameScan, scan(5));
  expect_refused(BearingReason::kOutOfOrder, scan(4));
  RangeImage& swapped = scan(6);
  std::swap(swapped.samples[10].t_us, swapped.samples[11].t_us);
  expect_refused(BearingReason::kOutOfOrder, swapped);
  EXPECT_TRUE(find(6).valid());
  // A later scan whose returns are earlier than those of the scan before.
  RangeImage& overlapping = scan(7);
  for (RangeSample& sample : overlapping.samples) sample.t_us = 6 * kPeriodUs;
  overlapping.samples[overlapping.samples.size() - 1].t_us = 7 * kPeriodUs + 90000;
  expect_refused(BearingReason::kOutOfOrder, overlapping);
}

TEST_F(BearingTest, AJumpIsBelievedTheThirdTime) {
  VERIFIES("LASSO-MOD-104~1");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  scene_.at_zero.p.z() += 25;
  expect_refused(BearingReason::kJump, scan(5));
  expect_refused(BearingReason::kJump, scan(6));
  const Bearing bearing = find(7);
  EXPECT_TRUE(bearing.valid());
  EXPECT_EQ(bearing.scans, 1u);
  EXPECT_GT(bearing.range_m(), 40);
  EXPECT_EQ(state_.jumps, 0u);
}

TEST_F(BearingTest, AJumpThatGoesAwayIsForgotten) {
  VERIFIES("LASSO-MOD-104~1");
  for (std::uint32_t k = 0; k < 5; ++k) ASSERT_TRUE(find(k).valid());
  const double z = scene_.at_zero.p.z();
  for (std::uint32_t k = 5; k < 9; k += 2) {
    scene_.at_zero.p.z() = z + 25;
    EXPECT_EQ(find(k).reason, BearingReason::kJump);
    scene_.at_zero.p.z() = z;
    EXPECT_TRUE(find(k + 1).valid());
  }
  EXPECT_EQ(state_.scans, 7u);
}

// The estimate would lie behind the sensor: it is not joined, though its error is within the gate.
TEST_F(BearingTest, NoTargetIsBehindTheSensor) {
  VERIFIES("LASSO-MOD-104~1");
  place(1.3, 2);
  ASSERT_TRUE(find(0).valid());
  state_.p_m = Vec3(0, 0, -0.3);
  state_.v_mps.setZero();
  state_.covariance = 0.01 * Mat6::Identity();
  RangeImage& image = scan(1);
  mission_.parameters.sigma0_m = 5;  // nearly nothing is known from the scan
  expect_refused(BearingReason::kJump, image);
}

TEST(BearingReason, HasAName) {
  VERIFIES("LASSO-MOD-104~1");
  EXPECT_EQ(std::string(to_string(BearingReason::kValid)), "valid");
  EXPECT_EQ(std::string(to_string(BearingReason::kJump)), "jump");
  EXPECT_EQ(std::string(to_string(static_cast<BearingReason>(99))), "unknown");
}

}  // namespace
}  // namespace lasso
