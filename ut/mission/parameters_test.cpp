#include "fsw/mission/parameters.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
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
    EXPECT_EQ(row.kind == ParameterKind::kChoice, row.choices[0] != '\0') << row.key;
    marks.*row.member = ++mark;
  }
  // The rows reach every double of the struct exactly once: each then holds another mark.
  EXPECT_EQ(sizeof(MissionParameters), parameter_rows().size() * sizeof(double));
  mark = 0;
  for (const ParameterRow& row : parameter_rows()) EXPECT_EQ(marks.*row.member, ++mark) << row.key;
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
