#include "mdat/campaign/paired.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

CampaignSource asking_at_most(double bound) {
  CampaignSource campaign;
  Criterion criterion;
  criterion.name = "accuracy";
  criterion.figure = "rms_mm";
  criterion.at_least = -std::numeric_limits<double>::infinity();
  criterion.at_most = bound;
  campaign.criteria = {criterion};
  return campaign;
}

ResultTable table_of(const std::vector<double>& rms_mm) {
  ResultTable table;
  table.figures = {"rms_mm"};
  table.columns = {"truth.range_m"};
  for (std::uint32_t i = 0; i < rms_mm.size(); ++i) table.rows.push_back({i, "ok", {rms_mm[i]}, {2.0 + i}});
  return table;
}

// By hand: differences 1, 2, 3, 0 have the mean 1.5 and the deviation sqrt(5/3); Student's t of 3 degrees of freedom is 3.182446 at 95 %.
TEST(PairedCases, MeanDifferenceHasStudentsInterval) {
  VERIFIES("LASSO-GND-066~1");
  const Comparison both = compare_cases(asking_at_most(3), table_of({1, 2, 3, 4, 5}), asking_at_most(3), table_of({2, 4, 6, 4, kNone}));
  ASSERT_EQ(both.figures.size(), 1U);
  const PairedFigure& figure = both.figures[0];
  EXPECT_EQ(figure.cases, 4U);
  EXPECT_EQ(figure.larger, 3U);
  EXPECT_EQ(figure.smaller, 0U);
  EXPECT_DOUBLE_EQ(figure.mean_a, 2.5);
  EXPECT_DOUBLE_EQ(figure.difference, 1.5);
  EXPECT_NEAR(figure.half_width, 3.182446 * std::sqrt(5.0 / 3 / 4), 1e-6);
  EXPECT_DOUBLE_EQ(figure.probability, 0.25) << "three of three tosses, either way: 2 / 8";
}

TEST(PairedCases, TellWhichChangedSides) {
  VERIFIES("LASSO-GND-066~1");
  const Comparison both = compare_cases(asking_at_most(3), table_of({1, 2, 3, 9, 9}), asking_at_most(3), table_of({2, 4, kNone, 1, 9}));
  ASSERT_EQ(both.criteria.size(), 1U);
  EXPECT_EQ(both.criteria[0].both, 1U);
  EXPECT_EQ(both.criteria[0].neither, 1U);
  EXPECT_EQ(both.criteria[0].only_a, (std::vector<std::uint32_t>{1, 2})) << "without a figure it is outside";
  EXPECT_EQ(both.criteria[0].only_b, std::vector<std::uint32_t>{3});
  EXPECT_DOUBLE_EQ(both.criteria[0].probability, 1) << "one of three, or fewer, or two, or more: all there is";
  const std::string text = comparison_text(both, "a b", "c");
  EXPECT_NE(text.find("within in A alone: case 1, 2; mdat campaign case c 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("within in B alone: case 3; mdat campaign case 'a b' 3\n"), std::string::npos) << text;
}

TEST(PairedCases, SignTestIsExact) {
  VERIFIES("LASSO-GND-066~1");
  EXPECT_NEAR(sign_test(0, 10), 2.0 / 1024, 1e-15);
  EXPECT_NEAR(sign_test(9, 10), 22.0 / 1024, 1e-15);
  EXPECT_DOUBLE_EQ(sign_test(5, 10), 1);
  EXPECT_DOUBLE_EQ(sign_test(0, 0), 1);
}

// Five of five cases are larger in one of four figures: 4 * 2 / 2^5, as one of four would be so unequal by chance.
TEST(PairedCases, ProbabilitiesAreCorrectedForTheNumberOfFigures) {
  VERIFIES("LASSO-GND-066~1");
  ResultTable a = table_of({1, 2, 3, 4, 5}), b = table_of({2, 3, 4, 5, 6});
  for (const char* name : {"nees", "lost", "wrong"}) {
    for (ResultTable* table : {&a, &b}) {
      table->figures.emplace_back(name);
      for (CaseRow& row : table->rows) row.figures.push_back(0);
    }
  }
  const Comparison both = compare_cases(asking_at_most(3), a, asking_at_most(3), b);
  ASSERT_EQ(both.figures.size(), 4U);
  EXPECT_DOUBLE_EQ(both.figures[0].probability, 0.25);
  EXPECT_EQ(both.figures[1].probability, 1);
}

// Nothing is drawn but the noise.
TEST(PairedCases, OfTwoSeedsAreRefused) {
  VERIFIES("LASSO-GND-066~1");
  CampaignSource other = asking_at_most(3);
  other.seed = 2;
  try {
    static_cast<void>(compare_cases(asking_at_most(3), table_of({1}), other, table_of({1})));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("the seed is 1 in A and 2 in B: these are not the same cases"), 0U) << error.what();
  }
}

TEST(PairedCases, OtherCasesAreRefusedAndThoseOfOneAloneLeftOut) {
  VERIFIES("LASSO-GND-066~1");
  const ResultTable five = table_of({1, 2, 3, 4, 5});
  ResultTable three = table_of({1, 2, 3});
  const Comparison both = compare_cases(asking_at_most(3), five, asking_at_most(3), three);
  EXPECT_EQ(both.cases, 3U);
  EXPECT_EQ(both.only_in_a, 2U);
  three.rows[1].drawn[0] = 7;
  try {
    static_cast<void>(compare_cases(asking_at_most(3), five, asking_at_most(3), three));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("case 1 has truth.range_m = 3 in A and 7 in B"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lasso::mdat
