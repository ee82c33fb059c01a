#include "mdat/missiondb/key_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mdat/missiondb/value_row.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// The loader's own words of what it expects.
TEST(KeyFacts, AgreeWithTheRowsOfTheLoader) {
  VERIFIES("LASSO-GND-147~1");
  for (const ValueRow& row : flight_rows()) {
    for (const std::string& key : {row.key, "scenario.spin.override." + row.key}) {
      const std::vector<KeyFacts> facts = facts_of(key);
      ASSERT_EQ(facts.size(), 1U) << key;
      EXPECT_EQ(facts[0].meaning, row.meaning);
      EXPECT_EQ(facts[0].unit, row.unit == "1" ? "" : row.unit);
      if (row.kind != ValueKind::kBoolean && row.maximum < 1e15) {
        EXPECT_EQ("expected " + facts[0].expected, expectation(row)) << key;
      }
    }
    EXPECT_EQ(facts_of(row.key)[0].preset, toml_text(row, row.preset)) << row.key;
  }
}

TEST(KeyFacts, KnowTablesAndChosenNames) {
  VERIFIES("LASSO-GND-147~1");
  EXPECT_TRUE(facts_of("scan").at(0).table);
  EXPECT_TRUE(facts_of("node.hubble").at(0).table);
  EXPECT_EQ(facts_of("node.hubble.position_m").at(0).key, "node.hubble.position_m");
  EXPECT_EQ(facts_of("node.hubble.position_m").at(0).unit, "m");
  EXPECT_GT(facts_of("motion.slow.position_m").size(), 1U) << "several kinds have it";
  EXPECT_EQ(facts_of("campaign.some.truth.range_m").at(0).expected,
            "a number from 0.01 to 10000 m, or a law, such as { uniform = [1, 2] }");
  for (const char* unknown : {"scna", "scan.pionts", "scan.points.x", "node.hubble.x"}) EXPECT_TRUE(facts_of(unknown).empty()) << unknown;
}

TEST(KeyFacts, ListEachKeyOnce) {
  VERIFIES("LASSO-GND-147~1");
  std::vector<std::string> keys;
  for (const KeyFacts& facts : keys_in("motion.slow")) keys.push_back(facts.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_NE(std::find(keys.begin(), keys.end(), "motion.slow.inertia"), keys.end());
  const std::vector<std::string> all = all_keys();
  EXPECT_NE(std::find(all.begin(), all.end(), "scenario.NAME.override.scan.points"), all.end());
}

TEST(KeyFacts, SayWhatIsCheckedTogether) {
  VERIFIES("LASSO-GND-147~1");
  const std::vector<std::string> with = checked_with("scan.points");
  EXPECT_NE(std::find(with.begin(), with.end(), "tracking.inliers_min"), with.end());
  EXPECT_EQ(std::find(with.begin(), with.end(), "scan.points"), with.end());
}

}  // namespace
}  // namespace lasso::mdat
