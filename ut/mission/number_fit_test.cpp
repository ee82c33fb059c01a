#include "fsw/mission/number_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "fsw/core/byte_codec.hpp"
#include "fsw/mission/parameter_area.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
constexpr int kLengthBits = 8;  // so few that either number type can be exceeded
constexpr std::int32_t kLongest = static_cast<std::int32_t>(N::kFarthest_m * (1 << kLengthBits));

// A record of a table, all of it zero.
class Record {
 public:
  explicit Record(TableId id, std::uint32_t words) : id_(id) {
    image_.tables[static_cast<std::size_t>(id) - 1] = {bytes_.data(), words, 1};
    image_.length_bits = kLengthBits;
  }
  void put(std::size_t word, std::int32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes_[4 * word + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
  Status check_with(std::size_t word, std::int32_t value) {
    put(word, value);
    const LoadFailure found = check_lengths_fit(image_, id_, 0);
    put(word, 0);
    EXPECT_EQ(found.table, found.status == Status::kOk ? 0U : static_cast<std::uint32_t>(id_));
    return found.status;
  }
  const ImageTable& table() const { return image_[id_]; }

 private:
  TableId id_;
  std::array<std::uint8_t, 128> bytes_{};
  FlightImage image_;
};

TEST(NumberFit, EveryLengthOfAnImageIsOneOfTheNumberType) {
  VERIFIES("LASSO-IMG-021~1");
  struct Case {
    TableId id;
    std::uint32_t words;
    std::uint32_t lengths;  // bits: the words that are
  };
  const Case cases[] = {{TableId::kElements, kElementWords, 0x3C0008U},
                        {TableId::kCurvatures, kCurvatureWords, 0x38U},
                        {TableId::kFootPoints, kFootWords, 0x7U},
                        {TableId::kEdges, kEdgeWords, 0x223FU},
                        {TableId::kHull, 3, 0x7U},
                        {TableId::kViews, kViewWords, 0x7F8U},
                        {TableId::kSymmetries, kSymmetryWords, 0x70U},
                        {TableId::kRayLists, 1, 0},
                        {TableId::kSearchGrid, kSearchGridWords, 0}};
  for (const Case& c : cases) {
    Record record(c.id, c.words);
    for (std::uint32_t word = 0; word < c.words; ++word) {
      SCOPED_TRACE(static_cast<int>(c.id) * 1000 + static_cast<int>(word));
      const bool length = (c.lengths >> word & 1U) != 0;
      EXPECT_EQ(record.check_with(word, kLongest), Status::kOk);
      EXPECT_EQ(record.check_with(word, -kLongest), Status::kOk);
      EXPECT_EQ(record.check_with(word, kLongest + 1), length ? Status::kBadValue : Status::kOk);
      EXPECT_EQ(record.check_with(word, -kLongest - 1), length ? Status::kBadValue : Status::kOk);
    }
  }
}

TEST(NumberFit, ATriangleHasNoFourthSide) {
  VERIFIES("LASSO-IMG-021~1");
  Record record(TableId::kElements, kElementWords);
  EXPECT_EQ(record.check_with(21, INT32_MIN), Status::kOk);
  EXPECT_EQ(record.check_with(20, INT32_MIN), Status::kBadValue) << "but a third one";
  EXPECT_EQ(record.check_with(3, INT32_MIN), Status::kBadValue) << "and a plane";
}

// 1 m wide cells, three bricks along each axis.
class GridOf {
 public:
  GridOf() {
    geometry_.put(kLengthFractionBits, kLengthBits);
    geometry_.put(kCellSize, 1 << kLengthBits);
    for (std::uint32_t axis = 0; axis < 3; ++axis) geometry_.put(kBricksX + axis, 3);
  }
  std::string misfit_with(std::size_t word, std::int32_t value) {
    geometry_.put(word, value);
    const char* what = misfit_of_grid(geometry_.table());
    return what == nullptr ? "" : what;
  }

 private:
  Record geometry_{TableId::kFieldGeometry, kFieldGeometryWords};
};

TEST(NumberFit, AGridReachesNoFartherThanTheNumberTypeHolds) {
  VERIFIES("LASSO-IMG-021~1");
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    GridOf grid;
    const std::int32_t last = kLongest - (24 << kLengthBits);
    EXPECT_EQ(grid.misfit_with(kOriginX + axis, -kLongest), "");
    EXPECT_EQ(grid.misfit_with(kOriginX + axis, last), "");
    EXPECT_EQ(grid.misfit_with(kOriginX + axis, last + 1).find("grid is larger than the number type holds"), 0U);
    EXPECT_EQ(grid.misfit_with(kOriginX + axis, -kLongest - 1).find("grid is larger than the number type holds"), 0U);
    EXPECT_EQ(grid.misfit_with(kOriginX + axis, 0), "");
    EXPECT_EQ(grid.misfit_with(kCenterX + axis, kLongest), "");
    EXPECT_EQ(grid.misfit_with(kCenterX + axis, kLongest + 1).find("the target's centre"), 0U);
    EXPECT_EQ(grid.misfit_with(kCenterX + axis, -kLongest - 1).find("the target's centre"), 0U);
  }
}

TEST(NumberFit, CellsAreNoSmallerThanTheNumberTypeHolds) {
  VERIFIES("LASSO-IMG-021~1");
  constexpr std::int32_t kBits = 30;
  GridOf grid;
  const auto smallest = static_cast<std::int32_t>(N::kSmallestCell_m * (1 << kBits));
  static_cast<void>(grid.misfit_with(kCellSize, smallest + 1));
  EXPECT_EQ(grid.misfit_with(kLengthFractionBits, kBits), "");
  EXPECT_EQ(grid.misfit_with(kCellSize, smallest).find("target.cell_size_m is less than the number type holds"), 0U);
  EXPECT_NE(grid.misfit_with(kCellSize, -1), "");
  EXPECT_EQ(grid.misfit_with(kCellSize, smallest + 1), "");
}

TEST(NumberFit, ASensorsRangesAndTheModelAreHeld) {
  VERIFIES("LASSO-IMG-021~1");
  SensorParameters sensor = preset_parameters();
  sensor.sigma_k_per_m = 0;
  sensor.range_max_m = N::kFarthest_m - 3;
  EXPECT_EQ(misfit_of(sensor, 3).what, nullptr);
  const Misfit misfit = misfit_of(sensor, 3.01);
  ASSERT_NE(misfit.what, nullptr);
  EXPECT_EQ(std::string(misfit.what).find("sensor.range_max_m"), 0U);
  EXPECT_STREQ(parameter_rows()[misfit.row].key, "sensor.range_max_m");
}

// At the farthest range that it measures.
TEST(NumberFit, ASensorsNoiseIsHeld) {
  VERIFIES("LASSO-IMG-021~1");
  SensorParameters sensor = preset_parameters();
  sensor.range_max_m = 10;
  sensor.sigma0_m = 0.6 * N::kLargestSigma_m;
  sensor.sigma_k_per_m = 0.0079 * N::kLargestSigma_m;
  sensor.sigma_angle_rad = 0.099 * N::kLargestSigma_m;
  EXPECT_EQ(misfit_of(sensor, 1).what, nullptr);
  sensor.sigma_k_per_m = 0.0081 * N::kLargestSigma_m;
  EXPECT_STREQ(parameter_rows()[misfit_of(sensor, 1).row].key, "sensor.sigma0_m");
  EXPECT_NE(std::string(misfit_of(sensor, 1).what).find("sensor.sigma_k_per_m"), std::string::npos);
  sensor.sigma_k_per_m = 0;
  sensor.sigma_angle_rad = 0.101 * N::kLargestSigma_m;
  EXPECT_STREQ(parameter_rows()[misfit_of(sensor, 1).row].key, "sensor.sigma_angle_rad");
}

TEST(NumberFit, AScanIsNoLongerThanTheNumberTypeHolds) {
  VERIFIES("LASSO-IMG-021~1");
  MissionParameters p = preset_parameters();
  p.duration_s = to_seconds(N::kLongestScan_us - kLateStart_us);
  EXPECT_EQ(misfit_of(p).what, nullptr);
  p.duration_s += 1e-3;
  EXPECT_EQ(std::string(misfit_of(p).what).find("scan.duration_s"), 0U);
  EXPECT_STREQ(parameter_rows()[misfit_of(p).row].key, "scan.duration_s");
}

// A model of a radius that neither number type holds, with the sensor's range.
TEST(NumberFit, WhatDoesNotFitHasItsPlaceInTheImage) {
  VERIFIES("LASSO-IMG-021~1");
  Record geometry(TableId::kFieldGeometry, kFieldGeometryWords);
  geometry.put(kLengthFractionBits, kLengthBits);
  std::array<std::uint8_t, 8 * kMaxParameters> values{};
  const std::uint32_t count = static_cast<std::uint32_t>(parameter_rows().size());
  FlightImage image;
  image.tables[static_cast<std::size_t>(TableId::kFieldGeometry) - 1] = geometry.table();
  image.tables[static_cast<std::size_t>(TableId::kParameters) - 1] = {values.data(), 2, count};
  image.tables[static_cast<std::size_t>(TableId::kSensors) - 1] = {values.data(), kSensorWords, 1};
  MissionParameters p = preset_parameters();
  const auto store = [&] {
    ByteWriter writer{Bytes(values.data(), values.size())};
    for (const ParameterRow& row : parameter_rows()) writer.f64(p.*row.member);
  };
  store();
  EXPECT_EQ(check_parameters_fit(image).status, Status::kOk);
  EXPECT_EQ(check_sensor_fit(image, 0).status, Status::kOk);
  geometry.put(kModelRadius, kLongest);
  const LoadFailure far = check_parameters_fit(image);
  EXPECT_EQ(far.status, Status::kBadValue);
  EXPECT_EQ(far.table, static_cast<std::uint32_t>(TableId::kParameters));
  EXPECT_STREQ(parameter_rows()[far.record].key, "sensor.range_max_m");
  const LoadFailure sensor = check_sensor_fit(image, 0);
  EXPECT_EQ(sensor.status, Status::kBadValue);
  EXPECT_EQ(sensor.table, static_cast<std::uint32_t>(TableId::kSensors));
  EXPECT_STREQ(sensor.what, far.what);
  p.duration_s = to_seconds(N::kLongestScan_us);
  store();
  EXPECT_STREQ(parameter_rows()[check_parameters_fit(image).record].key, "scan.duration_s") << "the first that is found";
}

}  // namespace
}  // namespace lasso
