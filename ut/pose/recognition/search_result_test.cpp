#include "fsw/pose/recognition/search_result.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(SearchText, NamesOutcomesAndReasons) {
  VERIFIES("LASSO-MOD-122~2");
  EXPECT_STREQ(to_string(SearchOutcome::kNone), "none");
  EXPECT_STREQ(to_string(SearchOutcome::kAccepted), "accepted");
  EXPECT_STREQ(to_string(SearchOutcome::kAmbiguous), "ambiguous");
  EXPECT_STREQ(to_string(SearchOutcome::kRejected), "rejected");
  EXPECT_STREQ(to_string(static_cast<SearchOutcome>(99)), "unknown");
  EXPECT_STREQ(to_string(SearchReason::kNotDone), "not_done");
  EXPECT_STREQ(to_string(SearchReason::kDistinct), "distinct");
  EXPECT_STREQ(to_string(SearchReason::kCompetitor), "competitor");
  EXPECT_STREQ(to_string(SearchReason::kTooFewReturns), "too_few_returns");
  EXPECT_STREQ(to_string(SearchReason::kUnexplained), "unexplained");
  EXPECT_STREQ(to_string(SearchReason::kNotRegistered), "not_registered");
  EXPECT_STREQ(to_string(SearchReason::kUnfinished), "unfinished");
  EXPECT_STREQ(to_string(static_cast<SearchReason>(99)), "unknown");
}

}  // namespace
}  // namespace lasso
