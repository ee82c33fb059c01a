#include "mdat/missiondb/campaign_columns.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Scenario plain() {
  Scenario scenario;
  scenario.ranges_m = {4, 5};
  scenario.offset_m = {0.1, 0.2};
  scenario.spin_radps = {0, 0, 0};
  scenario.model_gone_box_m = std::vector<double>(6, 0.0);
  return scenario;
}

TEST(CampaignColumns, GoWhereTheirNamesSayInSi) {
  VERIFIES("LASSO-GND-066~1");
  Scenario scenario = plain();
  set_column(scenario, "truth.range_m", 3);
  set_column(scenario, "truth.offset_m.y", -0.4);
  set_column(scenario, "truth.spin_degps.z", 5);
  set_column(scenario, "truth.model_gone_box_m.5", 9);
  set_column(scenario, "truth.tilt_deg", 30);
  set_column(scenario, "mission.tracking.start_sigma_deg", 2);
  EXPECT_EQ(scenario.ranges_m, std::vector<double>{3});
  EXPECT_EQ(scenario.offset_m, (std::vector<double>{0.1, -0.4}));
  EXPECT_NEAR(scenario.spin_radps[2], 5 * kRadPerDeg, 1e-15);
  EXPECT_EQ(scenario.model_gone_box_m[4], 9);
  EXPECT_NEAR(scenario.tilt_rad, 30 * kRadPerDeg, 1e-15);
  EXPECT_EQ(scenario.overrides.at("tracking.start_sigma_deg"), 2) << "in the key's unit, as overrides are";
}

// What is not there; a list, a number's element, one beyond the list; what would change truth and belief together.
TEST(CampaignColumns, AColumnThatIsNoneIsRefused) {
  VERIFIES("LASSO-GND-066~1");
  for (const char* column : {"truth.nothing", "mission.nothing", "range_m", "truth.", "", "truth.offset_m", "truth.tilt_deg.x",
                             "truth.offset_m.z", "truth.seed", "truth.kind", "mission.sensor.range_max_m", "mission.filter.period_s"}) {
    Scenario scenario = plain();
    EXPECT_EQ(find_column(column), nullptr) << column;
    EXPECT_THROW(set_column(scenario, column, 1), std::invalid_argument) << column;
  }
}

TEST(CampaignColumns, EachNumberOfAListHasAColumn) {
  VERIFIES("LASSO-GND-066~1");
  const std::vector<std::string> axes{"truth.spin_degps.x", "truth.spin_degps.y", "truth.spin_degps.z"};
  EXPECT_EQ(columns_of("truth.spin_degps", *find_row(truth_rows(), "spin_degps")), axes);
  const std::vector<std::string> corners = columns_of("truth.model_gone_box_m", *find_row(truth_rows(), "model_gone_box_m"));
  ASSERT_EQ(corners.size(), 6U);
  EXPECT_EQ(corners[4], "truth.model_gone_box_m.5");
  EXPECT_EQ(find_column(corners[4])->item, 4U);
}

// Each column changes one number of the scenario, and no two the same.
TEST(CampaignColumns, NoTwoAreOfOneNumber) {
  VERIFIES("LASSO-GND-066~1");
  std::set<std::string> names;
  for (const CampaignColumn& column : campaign_columns()) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_EQ(find_column(column.name), &column);
  }
}

}  // namespace
}  // namespace lasso::mdat
