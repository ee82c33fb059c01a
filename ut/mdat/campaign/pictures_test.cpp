#include "mdat/campaign/pictures.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::at_most;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t place = text.find(part); place != std::string::npos; place = text.find(part, place + 1)) ++count;
  return count;
}

Finding finding_in(const ResultTable& table, const Criterion& criterion) {
  Conclusion conclusion;
  conclusion.criterion = criterion;
  return finding_of(conclusion, table);
}

TEST(Bins, HaveEquallyManyCasesAndSayHowManyAreOutside) {
  VERIFIES("LASSO-GND-057~1");
  ResultTable table = test::table_with(30, 40);  // the last ten are outside
  const auto bins = bins_of(table, finding_in(table, at_most("", "rms_mm", 1, 0.5)), 0);
  ASSERT_EQ(bins.size(), 4U);
  EXPECT_EQ(bins[2].cases, 10U);
  EXPECT_EQ(bins[2].outside, 0U);
  EXPECT_EQ(bins[3].outside, 10U);
  EXPECT_NEAR(bins[1].low, 2.1, 1e-12);
  EXPECT_NEAR(bins[1].high, 2.19, 1e-12);
  EXPECT_NEAR(bins[1].mean, 2.145, 1e-12);
}

TEST(Bins, KeepEqualValuesTogether) {
  VERIFIES("LASSO-GND-057~1");
  ResultTable table = test::table_with(100, 100);
  for (std::size_t i = 0; i < 100; ++i) table.rows[i].drawn[0] = i < 75 ? 0 : 0.005;
  const auto bins = bins_of(table, finding_in(table, at_most("", "rms_mm", 1, 0.5)), 0);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_EQ(bins[0].cases, 75U);
  EXPECT_EQ(bins[1].cases, 25U);
  EXPECT_EQ(bins_of(test::table_of({1}), finding_in(table, at_most("", "rms_mm", 1, 0.5)), 0).size(), 1U);
}

TEST(Pictures, HaveAPanelAColumnAndWhatIsOutside) {
  VERIFIES("LASSO-GND-057~1");
  const test::MixedCampaign mixed;
  const Findings all = find(mixed.campaign, mixed.table, "d");
  Plotter plotter(testing::TempDir());
  EXPECT_TRUE(has_pair(all.table, all.findings[1]));
  const std::string distribution = distribution_picture(plotter, all.table, all.findings[1]);
  const std::string columns = columns_picture(plotter, all.table, all.findings[1]);
  EXPECT_EQ(plotter.missing(), "");
  for (const char* text : {">rms_mm<", ">cases not above, %<", ">truth.range_m<", ">truth.spin_degps.x<", ">outside<"})
    EXPECT_NE(distribution.find(text), std::string::npos) << text;
  EXPECT_EQ(count_of(columns, ">truth.range_m<"), 2U);
  EXPECT_EQ(count_of(columns, ">outside, %<"), 2U);
  EXPECT_NE(columns.find(">no value<"), std::string::npos);
}

// A vector's length and its components are no pair: they show the same.
TEST(Pictures, TakeTwoColumnsOfDifferentVectors) {
  VERIFIES("LASSO-GND-057~1");
  ResultTable table{{"rms_mm"}, {"spin.x", "spin.y", "|spin|", "range"}, {}};
  for (std::uint32_t i = 0; i < 20; ++i) table.rows.push_back({i, "ok", {1.0 * i}, {1.0 * i, 2.0 * i, 3.0 * i, (7 * i) % 20 * 1.0}});
  EXPECT_TRUE(has_pair(table, finding_in(table, at_most("", "rms_mm", 5, 0.5))));
  for (CaseRow& row : table.rows) row.drawn[3] = 1;
  EXPECT_FALSE(has_pair(table, finding_in(table, at_most("", "rms_mm", 5, 0.5))));
}

TEST(Pictures, DrawSomeOfVeryManyCases) {
  VERIFIES("LASSO-GND-057~1");
  const ResultTable table = test::table_with(12000, 12500);
  Plotter plotter(testing::TempDir());
  const Finding finding = finding_in(table, at_most("", "rms_mm", 1, 0.5));
  EXPECT_LT(columns_picture(plotter, table, finding).size(), 300000U);
  EXPECT_EQ(plotter.missing(), "");
}

}  // namespace
}  // namespace lasso::mdat
