#include "mdat/campaign/law_text.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(LawText, IsWhatWasWritten) {
  VERIFIES("LASSO-GND-057~1");
  EXPECT_EQ(law_text(NumberLaw(Fixed{0.1})), "0.1 in every case");
  EXPECT_EQ(law_text(NumberLaw(Uniform{2, 7})), "uniform, 2 to 7");
  EXPECT_EQ(law_text(NumberLaw(LogUniform{1e-5, 1e-3})), "uniform in the logarithm, 1e-05 to 0.001");
  EXPECT_EQ(law_text(NumberLaw(Normal{0, 0.05, -test::kInfinite, test::kInfinite})), "normal, mean 0, sigma 0.05");
  EXPECT_EQ(law_text(NumberLaw(Normal{0, 0.05, -0.1, 0.1})), "normal, mean 0, sigma 0.05, within -0.1 to 0.1");
  EXPECT_EQ(law_text(NumberLaw(OneOf{{0, 0.005}, {3, 1}})), "one of 0, 0.005, weights 3, 1");
  EXPECT_EQ(law_text(NumberLaw(OneOf{{0, 0.005}, {2, 2}})), "one of 0, 0.005");
  EXPECT_EQ(law_text(AnyDirection{Uniform{0, 5}}), "any direction, length uniform, 0 to 5");
  EXPECT_EQ(law_text(AnyAttitude{}), "any attitude");
  EXPECT_EQ(law_text(Correlated{{0, 1}, {1, 0, 0, 4}, {-9, -9}, {9, 9}}), "normal together, mean 0, 1, covariance by rows 1, 0, 0, 4");
  EXPECT_EQ(law_text(Rows{"cases.csv", false, {}}), "rows of cases.csv, drawn");
}

}  // namespace
}  // namespace lasso::mdat
