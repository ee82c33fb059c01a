#include "fsw/sense/pixel_selector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "fsw/sense/acquisition.hpp"
#include "fsw/sense/range_image.hpp"
#include "ut/sense/pixel_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// By its own arithmetic: sorts the pixels of each cell by their distance to the aim point.
std::vector<RangeSample> brute_force(const std::vector<RangeSample>& pixels, const ScanPlan& plan, const CellGrid& grid) {
  std::map<std::pair<int, int>, std::vector<std::pair<double, RangeSample>>> cells;
  for (RangeSample pixel : pixels) {
    const auto [x, y] = place_of(pixel);
    const double u = grid.columns * (x - plan.center_x + plan.half_x) / (2 * plan.half_x);
    const double v = grid.rows * (y - plan.center_y + plan.half_y) / (2 * plan.half_y);
    if (u < 0 || v < 0 || u >= grid.columns || v >= grid.rows) continue;
    const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
    const CellPoint aim = aim_point(static_cast<std::uint32_t>(row) * grid.columns + static_cast<std::uint32_t>(column), plan.scan_id);
    const double distance = std::hypot(u - column - aim.x / 32768.0, v - row - aim.y / 32768.0);
    pixel.t_us = kExposure_us;
    if (pixel.state != RayState::kHit) pixel.range_m = 0;
    cells[{row, column}].push_back({distance + (pixel.state == RayState::kInvalid ? 10 : 0), pixel});
  }
  std::vector<RangeSample> kept;
  for (auto& [place, candidates] : cells) {
    kept.push_back(
        std::min_element(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.first < b.first; })->second);
  }
  return kept;
}

TEST_F(PixelSelectorTest, EachCellKeepsThePixelNearestToItsAimPointWhateverItSaw) {
  VERIFIES("LASSO-SNS-050~1 LASSO-SNS-051~1");
  frame.pixels = disc(256, 0.25);
  frame.distance = {0.5 / 256, 0.5 / 256};
  for (const ScanPlan& plan : {window(0.013, -0.02, 0.171, 0.1234), window(0, 0, 0.25, 0.25, 4096), window(-0.1, 0.1, 0.02, 0.15, 64)}) {
    const CellGrid grid = cell_grid(plan, frame.distance);
    const std::vector<RangeSample> kept = select(plan);
    ASSERT_EQ(kept.size(), grid.cells());
    EXPECT_LE(kept.size(), plan.points);
    EXPECT_GT(kept.size(), 0.9 * plan.points);
    EXPECT_EQ(selector.samples_of(plan), kept.size());
    EXPECT_TRUE(same(kept, brute_force(frame.pixels, plan, grid)));
  }
}

TEST_F(PixelSelectorTest, OrderAndPiecesOfTheFrameDoNotMatter) {
  VERIFIES("LASSO-SNS-052~1");
  frame.pixels = disc(90, 0.25);
  frame.distance = {0.5 / 90, 0.5 / 90};
  // Pixels as near to an aim point as others: the same places again with other ranges, errors and states.
  const std::vector<RangeSample> once = frame.pixels;
  for (RangeSample pixel : once) {
    pixel.sigma_factor = 2;
    frame.pixels.push_back(pixel);
    pixel.range_m += 1;
    frame.pixels.push_back(pixel);
    if (pixel.state == RayState::kHit) pixel.state = RayState::kMiss;
    frame.pixels.push_back(pixel);
  }
  const ScanPlan plan = window(0.01, 0.02, 0.2, 0.15, 512);
  const std::vector<RangeSample> expected = select(plan);
  std::mt19937 random(20261128);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{127}, kMaxSamplesPerPoll, std::size_t{1000}}) {
    std::shuffle(frame.pixels.begin(), frame.pixels.end(), random);
    frame.piece = piece;
    EXPECT_TRUE(same(select(plan, 40000), expected)) << "pieces of " << piece;
  }
  std::reverse(frame.pixels.begin(), frame.pixels.end());
  EXPECT_TRUE(same(select(plan, 40000), expected));
}

TEST_F(PixelSelectorTest, ACallLooksAtNoMorePixelsThanItsBound) {
  VERIFIES("LASSO-SNS-053~1");
  frame.pixels = disc(256, 0.25);
  ASSERT_EQ(selector.start(window(0, 0, 0.2, 0.2), kStart_us), Status::kOk);
  RangeSample out[kMaxSamplesPerPoll];
  std::size_t before = 0;
  for (int i = 0; i < 15; ++i) {
    const SensorPoll poll = selector.poll(kStart_us + 1000, Span<RangeSample>(out));
    EXPECT_EQ(poll.count, 0U);
    EXPECT_EQ(frame.next - before, kMaxPixelsPerPoll);
    before = frame.next;
  }
  EXPECT_EQ(selector.poll(kStart_us + 1000, Span<RangeSample>(out)).count, kMaxSamplesPerPoll) << "65,536 pixels in sixteen calls";
}

TEST_F(PixelSelectorTest, AFrameThatComesSlowlyIsTakenAsItComes) {
  frame.pixels = disc(40, 0.25);
  frame.pauses = true;
  EXPECT_EQ(select(window(0, 0, 0.2, 0.2)).size(), cell_grid(window(0, 0, 0.2, 0.2), frame.distance).cells());
}

TEST_F(PixelSelectorTest, MissesAndPixelsWithoutAMeasurementAreKeptApart) {
  VERIFIES("LASSO-SNS-055~1");
  frame.pixels = disc(100, 0.25);
  frame.distance = {0.005, 0.005};
  const ScanPlan plan = window(0, 0, 0.25, 0.25, 400);
  for (RangeSample& pixel : frame.pixels) pixel.state = RayState::kMiss;
  for (const RangeSample& sample : select(plan)) {
    EXPECT_EQ(sample.state, RayState::kMiss);
    EXPECT_EQ(sample.range_m, 0);
    EXPECT_EQ(sample.t_us, kExposure_us);
  }
  for (RangeSample& pixel : frame.pixels) pixel.state = RayState::kInvalid;
  for (const RangeSample& sample : select(plan)) EXPECT_EQ(sample.state, RayState::kInvalid);
  // One miss among pixels without a measurement is what its cell says, wherever in the cell it lies.
  frame.pixels[4321].state = RayState::kMiss;
  const std::vector<RangeSample> kept = select(plan);
  EXPECT_EQ(std::count_if(kept.begin(), kept.end(), [](const RangeSample& s) { return s.state == RayState::kMiss; }), 1);
}

// Sixteen strata: each holds its share of what is kept, and the share of hits is that of the pixels, as nothing favours them.
TEST_F(PixelSelectorTest, WhatIsKeptIsSpreadOverTheWindowAndCountsAreUnbiased) {
  VERIFIES("LASSO-SNS-050~1 LASSO-SNS-051~1");
  frame.pixels = disc(256, 0.25);
  frame.distance = {0.5 / 256, 0.5 / 256};
  double hits = 0, all = 0;
  for (std::uint32_t scan = 0; scan < 40; ++scan) {
    ScanPlan plan = window(0, 0, 0.25, 0.25);
    plan.scan_id = scan;
    std::map<std::pair<int, int>, int> strata;
    for (const RangeSample& sample : select(plan)) {
      if (sample.state == RayState::kHit) ++hits;
      ++all;
      const auto [x, y] = place_of(sample);
      ++strata[{static_cast<int>(std::floor(8 * x)), static_cast<int>(std::floor(8 * y))}];
    }
    ASSERT_EQ(strata.size(), 16U);
    for (const auto& [stratum, count] : strata) EXPECT_EQ(count, 64);
  }
  const auto of_pixels = std::count_if(frame.pixels.begin(), frame.pixels.end(), [](const auto& p) { return p.state == RayState::kHit; });
  EXPECT_NEAR(hits / all, static_cast<double>(of_pixels) / 65536, 0.002);
}

// In each tenth of a cell, along each side, are a tenth of the aim points, from cell to cell and from scan to scan.
TEST(AimPoint, FillsItsCellEvenly) {
  for (int which = 0; which < 2; ++which) {
    std::vector<int> x(10), y(10);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const CellPoint aim = which == 0 ? aim_point(i, 3) : aim_point(77, i);
      ++x.at(10 * aim.x / kCellParts);
      ++y.at(10 * aim.y / kCellParts);
    }
    for (int tenth = 0; tenth < 10; ++tenth) {
      EXPECT_NEAR(x.at(static_cast<std::size_t>(tenth)), 100, 5);
      EXPECT_NEAR(y.at(static_cast<std::size_t>(tenth)), 100, 5);
    }
  }
}

TEST(CellGridTest, CellsAreAboutSquareFillThePointsAndAreNoSmallerThanAPixel) {
  VERIFIES("LASSO-SNS-050~1");
  std::mt19937 random(5);
  std::uniform_real_distribution<double> half(0.003, 1), fine(1e-4, 0.02);
  for (int i = 0; i < 5000; ++i) {
    const ScanPlan plan = window(0, 0, half(random), half(random), static_cast<std::uint16_t>(64 + random() % 4033));
    const PixelPitch pitch{fine(random), fine(random)};
    const CellGrid grid = cell_grid(plan, pitch);
    ASSERT_LE(grid.cells(), plan.points);
    ASSERT_TRUE(grid.columns == 1 || 2 * plan.half_x / grid.columns >= pitch.x * (1 - 1e-12));
    ASSERT_TRUE(grid.rows == 1 || 2 * plan.half_y / grid.rows >= pitch.y * (1 - 1e-12));
    const double most = std::max(1.0, std::floor(2 * plan.half_x / pitch.x)) * std::max(1.0, std::floor(2 * plan.half_y / pitch.y));
    ASSERT_GE(grid.cells(), 0.5 * std::min<double>(plan.points, most));
  }
  EXPECT_EQ(cell_grid(window(0, 0, 2, 1e-5), {1e-9, 1e-9}).cells(), 1024U) << "a line";
  EXPECT_EQ(cell_grid(window(0, 0, 1e-5, 2), {1e-9, 1e-9}).cells(), 1024U);
  EXPECT_LE(cell_grid(window(0, 0, 0.1, 0.1), {0, std::numeric_limits<double>::quiet_NaN()}).cells(), 1024U) << "no such pitch";
}

TEST_F(PixelSelectorTest, PixelsThatCannotBeAreCountedAndDisplaceNothing) {
  VERIFIES("LASSO-SNS-054~1");
  frame.pixels = disc(100, 0.25);
  frame.distance = {0.005, 0.005};
  const ScanPlan plan = window(0, 0, 0.25, 0.25, 400);
  const std::vector<RangeSample> expected = select(plan);
  const std::vector<RangeSample> good = frame.pixels;
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  std::uint32_t bad = 0;
  const auto spoil = [&](const RangeSample& pixel) {
    frame.pixels.push_back(pixel);
    ++bad;
  };
  for (const RangeSample& pixel : good) {
    RangeSample spoilt = pixel;
    spoilt.state = static_cast<RayState>(17);
    spoil(spoilt);
    spoilt = pixel;
    spoilt.state = RayState::kLost;
    spoil(spoilt);
    spoilt = pixel;
    spoilt.direction[1] = nan;
    spoil(spoilt);
    spoilt = pixel;
    spoilt.direction[2] = 2;
    spoil(spoilt);
    spoilt = pixel;
    spoilt.state = RayState::kHit;
    spoilt.range_m = -1;
    spoil(spoilt);
    spoilt.range_m = infinite;
    spoil(spoilt);
  }
  EXPECT_TRUE(same(select(plan), expected));
  EXPECT_GE(selector.counters().samples_refused, 5U + 4 * 400)
      << "5 of the sensor's own, and four of each cell that lie where the kept pixel does";
  EXPECT_LT(selector.counters().samples_refused, 5 + bad);
}

TEST_F(PixelSelectorTest, PixelsBesideAndBehindTheWindowAreLeftOut) {
  const ScanPlan plan = window(0, 0, 0.1, 0.1, 100);
  frame.distance = {0.2, 0.2};  // one cell
  for (const double x : {-0.1001, 0.1001}) {
    frame.pixels.push_back(pixel_at(x, 0, RayState::kHit, 3));
    frame.pixels.push_back(pixel_at(0, x, RayState::kHit, 3));
  }
  RangeSample behind = pixel_at(0, 0, RayState::kHit, 3);
  for (float& component : behind.direction) component = 0.0F - component;
  frame.pixels.push_back(behind);
  std::vector<RangeSample> kept = select(plan);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].state, RayState::kLost);
  frame.pixels.push_back(pixel_at(0.0999, -0.0999, RayState::kHit, 4));
  kept = select(plan);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].range_m, 4);
}

TEST_F(PixelSelectorTest, ACellThatNoPixelHasComeForIsLostAndTheVerdictCountsIt) {
  VERIFIES("LASSO-SNS-056~1");
  frame.pixels = disc(100, 0.25);
  frame.distance = {0.005, 0.005};
  const ScanPlan plan = window(0, 0, 0.25, 0.25, 400);
  const auto verdict_of = [&](double share) {
    frame.pixels = disc(100, 0.25);
    frame.pixels.resize(static_cast<std::size_t>(share * 10000));
    Acquisition acquisition;
    const auto image = std::make_unique<RangeImage>();
    EXPECT_EQ(acquisition.start(selector, plan, kStart_us, *image), Status::kOk);
    for (int i = 0; i < 50; ++i) acquisition.step(selector, kStart_us + 1000, *image);
    return acquisition.finish(selector, *image);
  };
  EXPECT_EQ(verdict_of(1).lost, 0);
  EXPECT_TRUE(verdict_of(1).usable);
  EXPECT_EQ(verdict_of(0.9).lost, 40) << "two rows of twenty cells";
  EXPECT_TRUE(verdict_of(0.9).usable);
  EXPECT_FALSE(verdict_of(0.7).usable);
  EXPECT_EQ(verdict_of(0.7).loss, ScanLoss::kThin);
}

// A window of 20 x 20 pixels: what is asked for is what the sensor has, and a scan of so few is whole.
TEST_F(PixelSelectorTest, AWindowOfFewPixelsIsAWholeScan) {
  VERIFIES("LASSO-SNS-050~1");
  frame.pixels = disc(100, 0.25);
  frame.distance = {0.005, 0.005};
  const ScanPlan plan = window(0.002, 0.001, 0.05, 0.05);
  Acquisition acquisition;
  const auto image = std::make_unique<RangeImage>();
  ASSERT_EQ(acquisition.start(selector, plan, kStart_us, *image), Status::kOk);
  for (int i = 0; i < 50; ++i) acquisition.step(selector, kStart_us + 1000, *image);
  const ScanVerdict verdict = acquisition.finish(selector, *image);
  EXPECT_TRUE(verdict.usable);
  EXPECT_EQ(verdict.count, 400);
  EXPECT_EQ(verdict.lost, 0);
}

TEST_F(PixelSelectorTest, PiecesThatDoNotBelongTogetherLoseTheScan) {
  VERIFIES("LASSO-SNS-057~1");
  const ScanPlan plan = window(0, 0, 0.2, 0.2);
  frame.pixels = disc(100, 0.25);
  frame.other_frame_at = 5000;
  EXPECT_EQ(lost_with(plan), Status::kBadOrder);
  EXPECT_EQ(frame.aborts, 1);
  frame.other_frame_at = 1u << 30;
  frame.silent_at = 3000;
  frame.lose = Status::kTimeout;
  EXPECT_EQ(lost_with(plan), Status::kTimeout);
  frame.silent_at = 1u << 30;
  frame.overclaims = true;
  EXPECT_EQ(lost_with(plan), Status::kBadLength);
  EXPECT_EQ(frame.aborts, 3);
  frame.overclaims = false;
  frame.ended = false;
  EXPECT_EQ(lost_with(plan), Status::kOk) << "a frame that does not end is never given";
}

TEST_F(PixelSelectorTest, RefusesWhatItCannotDo) {
  RangeSample out[kMaxSamplesPerPoll];
  ScanPlan plan = window(0, 0, 0.2, 0.2);
  EXPECT_EQ(selector.poll(kStart_us, Span<RangeSample>(out)).status, Status::kNoData);
  plan.points = 1;
  EXPECT_EQ(selector.start(plan, kStart_us), Status::kBadValue);
  plan.points = 1024;
  const AimedRay ray{};
  plan.aimed = {&ray, 1};
  EXPECT_EQ(selector.start(plan, kStart_us), Status::kBadValue) << "it cannot aim";
  EXPECT_FALSE(selector.can_aim());
  plan.aimed = {};
  frame.refuse = Status::kMissing;
  EXPECT_EQ(selector.start(plan, kStart_us), Status::kMissing);
  frame.refuse = Status::kOk;
  ASSERT_EQ(selector.start(plan, kStart_us), Status::kOk);
  EXPECT_EQ(selector.start(plan, kStart_us), Status::kBusy);
  selector.abort();
  EXPECT_EQ(selector.poll(kStart_us, Span<RangeSample>(out)).status, Status::kNoData);
  selector.permit_laser(true);
  EXPECT_EQ(frame.permissions, 1);
}

// What a dense sensor need not have.
TEST(PixelSensorTest, HasNoLineUnlessItSaysSo) {
  class Plain final : public PixelSensor {
    PixelPitch pitch() const override { return {1, 1}; }
    Status start(const ScanPlan&, TimeUs) override { return Status::kOk; }
    PixelPoll poll(TimeUs, Span<RangeSample>) override { return {}; }
    void abort() override {}
    void permit_laser(bool) override {}
  } plain;
  PixelSensor& sensor = plain;
  EXPECT_EQ(sensor.counters().frames, 0U);
}

}  // namespace
}  // namespace lasso
