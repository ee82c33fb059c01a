#include "fsw/mission/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Parameters, PresetsAreValid) {
  VERIFIES("LASSO-IMG-004~1");
  std::size_t row = 0;
  EXPECT_EQ(validate(preset_parameters(), row), Status::kOk);
}

TEST(Parameters, EveryRowIsOfItsOwnAndComplete) {
  VERIFIES("LASSO-IMG-006~1");
  std::set<std::string> keys;
  MissionParameters marks{};
  double mark = 0;
  for (const ParameterRow& row : parameter_rows()) {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_LE(row.minimum, row.preset) << row.key;
    EXPECT_LE(row.preset, row.maximum) << row.key;
    EXPECT_GT(std::strlen(row.meaning), 10u) << row.key;
    EXPECT_STRNE(row.unit, "") << row.key;
    EXPECT_EQ(row.kind == ParameterKind::kChoice, row.choices[0] != '\0') << row.key;
    marks.*row.member = ++mark;
  }
  // The rows reach every double of the struct exactly once: each then holds another mark.
  EXPECT_EQ(sizeof(MissionParameters), parameter_rows().size() * sizeof(double));
  mark = 0;
  for (const ParameterRow& row : parameter_rows()) EXPECT_EQ(marks.*row.member, ++mark) << row.key;
}

std::string section_of(const ParameterRow& row) {
  const std::string key = row.key;
  return key.substr(0, key.rfind('.'));
}

// A new row stands at the end of its section, with the next id ever.
TEST(Parameters, IdsAreUniqueAndRiseInEachSection) {
  VERIFIES("LASSO-IMG-006~1");
  std::set<std::uint16_t> ids;
  std::map<std::string, std::uint16_t> newest;
  for (const ParameterRow& row : parameter_rows()) {
    EXPECT_TRUE(ids.insert(row.id).second) << row.key;
    EXPECT_LT(row.id, kNextParameterId) << row.key;
    EXPECT_EQ(std::count(std::begin(kRetiredParameterIds), std::end(kRetiredParameterIds), row.id), 0) << row.key;
    const auto [last, first] = newest.emplace(section_of(row), row.id);
    EXPECT_TRUE(first || row.id > last->second) << row.key;
    last->second = row.id;
  }
  // Each id that was ever given away is a row's, or retired.
  EXPECT_EQ(ids.size() + std::size(kRetiredParameterIds), kNextParameterId);
}

// Of a table as a later version has it: a row is gone, and a new one stands in front of older ones.
TEST(Parameters, AnIdFindsItsRowWhereverItStands) {
  VERIFIES("LASSO-IMG-018~1");
  ParameterRow rows[4] = {};
  const std::uint16_t ids[] = {0, 1, 104, 3}, others[] = {2, 4, 103, 105, 0xFFFF};
  for (std::size_t i = 0; i < 4; ++i) rows[i].id = ids[i];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(index_of_id(Span<const ParameterRow>(rows), ids[i]), i);
  for (const std::uint16_t id : others) EXPECT_EQ(index_of_id(Span<const ParameterRow>(rows), id), 4U) << id;
  EXPECT_EQ(index_of_id(Span<const ParameterRow>(), 0), 0U);
  for (std::size_t i = 0; i < parameter_rows().size(); ++i) EXPECT_EQ(index_of_id(parameter_rows(), parameter_rows()[i].id), i);
}

TEST(Parameters, TheFirstRowsAreThoseOfASensor) {
  VERIFIES("LASSO-IMG-006~1 LASSO-SNS-047~1");
  SensorParameters sensor = preset_parameters();
  std::size_t bad_row = 0;
  EXPECT_EQ(validate(sensor, bad_row), Status::kOk);
  ASSERT_EQ(sensor_rows().size(), kSensorValues);
  for (std::size_t i = 0; i < kSensorValues; ++i) {
    const ParameterRow& row = sensor_rows()[i];
    EXPECT_EQ(std::string(row.key).substr(0, 7), "sensor.");
    sensor = preset_parameters();
    sensor.*sensor_member(row) = (row.maximum + 1) * row.to_si;
    EXPECT_EQ(validate(sensor, bad_row), Status::kBadValue);
    EXPECT_EQ(bad_row, i);
  }
}

TEST(Parameters, RefusesWhatIsOutsideARowsRange) {
  VERIFIES("LASSO-IMG-004~1");
  for (std::size_t i = 0; i < parameter_rows().size(); ++i) {
    const ParameterRow& row = parameter_rows()[i];
    const double step = 1e-3 * (row.maximum - row.minimum) + 1e-9;
    for (double value : {row.minimum - step, row.maximum + step}) {
      MissionParameters parameters = preset_parameters();
      parameters.*row.member = value * row.to_si;
      std::size_t bad_row = 0;
      EXPECT_EQ(validate(parameters, bad_row), Status::kBadValue) << row.key;
      EXPECT_EQ(bad_row, i) << row.key;
    }
    for (double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      MissionParameters parameters = preset_parameters();
      parameters.*row.member = value;
      std::size_t bad_row = 0;
      EXPECT_EQ(validate(parameters, bad_row), Status::kNotFinite) << row.key;
    }
  }
}

TEST(Parameters, RefusesFractionsWhereNumbersAreWhole) {
  VERIFIES("LASSO-IMG-004~1");
  for (const ParameterRow& row : parameter_rows()) {
    if (row.kind == ParameterKind::kReal) continue;
    MissionParameters parameters = preset_parameters();
    parameters.*row.member = row.minimum + 0.5;
    std::size_t bad_row = 0;
    EXPECT_EQ(validate(parameters, bad_row), Status::kBadValue) << row.key;
  }
}

}  // namespace
}  // namespace lasso
