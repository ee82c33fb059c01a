#include "mdat/paper/results.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

PaperResult some_result() {
  PaperResult result;
  result.machine = "a machine";
  TableResult table;
  for (const double mean : {0.0001, 0.25}) {
    VariantResult variant;
    variant.variant.name = mean < 0.1 ? "noise_free" : "noisy";
    variant.all.registration.z_mm = {mean, 2 * mean};
    variant.all.time.median_us = 1000;
    table.variants.push_back(variant);
  }
  result.simulation.tables.push_back(table);
  result.laboratory.stands = 1;
  result.laboratory.mock_ups = 2;
  result.laboratory.time.median_us = 3000;
  LaboratoryRange range;
  for (const double z_m : {0.001, -0.003}) {
    StandResult stand;
    stand.errors = {z_m, 0.01, 0, 0};
    range.stands.push_back(stand);
  }
  range.budget.resize(1);
  range.budget[0][0][2] = 4e-6;
  result.laboratory.ranges.push_back(range);
  return result;
}

TEST(PaperResults, ARowStandsBesideEachOfThePapersValues) {
  VERIFIES("LASSO-MDT-120~1");
  const std::vector<PaperRow> rows = paper_rows(some_result());
  ASSERT_EQ(rows.size(), 10U) << "six axes, two of the laboratory, two times";
  // The paper's, as its tables have them.
  const std::pair<const char*, const char*> stated[] = {{"table 1, X", "0.53 ± 4.87"},       {"table 1, Y", "3.33 ± 2.79"},
                                                        {"table 1, Z", "-3.36 ± 6.25"},      {"table 1, yaw", "0.01 ± 0.2"},
                                                        {"table 1, pitch", "-0.004 ± 0.19"}, {"table 1, roll", "0.004 ± 0.16"},
                                                        {"table 2, Z", "5.01 ± 2.62"},       {"table 2, rotation", "0.46 ± 0.24"}};
  for (std::size_t i = 0; i < std::size(stated); ++i) {
    EXPECT_EQ(rows[i].what.substr(0, std::string(stated[i].first).size()), stated[i].first);
    EXPECT_EQ(rows[i].paper, stated[i].second) << rows[i].what;
  }
  EXPECT_EQ(rows[2].here, "1.0e-04 ± 2.0e-04");
  EXPECT_EQ(rows[2].noisy, "0.2500 ± 0.5000");
  EXPECT_EQ(rows[6].noisy, "2.0000 ± 1.0000") << "of the absolute errors";
  EXPECT_EQ(rows[8].paper, "9.2");
  EXPECT_EQ(rows[9].paper, "148.0");
  EXPECT_EQ(rows[8].here, "1.00");
  EXPECT_EQ(rows[8].noisy, "3.00");
}

TEST(PaperResults, TheTerminalSaysWhetherTheBudgetIsHeld) {
  VERIFIES("LASSO-MDT-120~1");
  const std::string text = paper_text(some_result());
  EXPECT_NE(text.find("above 1.1"), std::string::npos) << "2.24 mm of 2 mm: " << text;
  EXPECT_NE(text.find("a machine"), std::string::npos);
}

TEST(PaperResults, WhatIsNotKnownOfThePaperIsListed) {
  VERIFIES("LASSO-MDT-120~1");
  std::string unknown;
  for (const PaperItem& item : paper_items()) {
    if (item.shows.rfind("not known here", 0) == 0) unknown += item.name + ";";
  }
  EXPECT_EQ(unknown, "Figure 4;Figure 5;Figure 9;Figure 12;Figure 14;");
}

}  // namespace
}  // namespace lasso::mdat
