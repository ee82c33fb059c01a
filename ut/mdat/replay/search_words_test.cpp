#include "mdat/replay/search_words.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string words(SearchReason reason, const std::optional<Competitor>& rival = std::nullopt) {
  SearchResult result;
  result.reason = reason;
  result.returns = 61;
  result.disagreement = 0.34;
  return search_words(result, rival, SearchLimits());
}

void expect_said(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  EXPECT_EQ(text.find(','), std::string::npos) << "a field of a table: " << text;
}

// Each competitor is judged by the flight code's own rule; the words are to name what it went by.
TEST(SearchWords, SayByWhichRuleACompetitorStands) {
  VERIFIES("LASSO-MDT-072~1");
  const Competitor other_object{2.3, true, 1.0, 1.9, 1.7, 0.12, 1};
  ASSERT_FALSE(is_outscored(other_object, 1.3));
  expect_said(words(SearchReason::kCompetitor, other_object),
              {"2.30 times", "less than 3.9", "12 % unexplained", "1.70", "another object"});
  const Competitor alike{1.03, true, 1.05, 1.0, 1.0, 0.01, 1};
  ASSERT_FALSE(is_outscored(alike, 1.3));
  expect_said(words(SearchReason::kCompetitor, alike), {"1.03 times", "less than the least ratio 1.3", "does not tell them apart", "1.05"});
  const Competitor as_good{1.5, true, 1.1, 1.0, 1.0, 0.01, 1};
  ASSERT_FALSE(is_outscored(as_good, 1.3));
  expect_said(words(SearchReason::kCompetitor, as_good), {"1.50 times", "less than 1.95", "explains the returns about as well", "1.10"});
}

TEST(SearchWords, SayByWhichRuleThePoseIsAccepted) {
  VERIFIES("LASSO-MDT-072~1");
  const Competitor by_noise{1.03, true, 4.1, 1.0, 1.0, 0.01, 1};
  ASSERT_TRUE(is_outscored(by_noise, 1.3));
  expect_said(words(SearchReason::kDistinct, by_noise),
              {"1.03 times", "less than the least ratio 1.3", "noise of the returns tells them apart", "4.10", "1.00"});
  const Competitor far{4.2, false, 0, 1.0, 1.0, 0.01, 1};
  ASSERT_TRUE(is_outscored(far, 1.3));
  expect_said(words(SearchReason::kDistinct, far), {"4.20 times", "more than 1.95"});
  const Competitor both{1.5, true, 2.0, 1.0, 1.0, 0.01, 1};
  ASSERT_TRUE(is_outscored(both, 1.3));
  expect_said(words(SearchReason::kDistinct, both), {"1.50 times", "more than the least ratio 1.3", "agrees"});
  expect_said(words(SearchReason::kDistinct), {"no competitor"});
}

TEST(SearchWords, SayWhatIsAskedForAndWhatIsThere) {
  VERIFIES("LASSO-MDT-072~1");
  expect_said(words(SearchReason::kTooFewReturns), {"61 returns", "a search needs", "80"});
  expect_said(words(SearchReason::kUnexplained), {"34 %", "at most", "20 %"});
  expect_said(words(SearchReason::kNotRegistered), {"direction"});
  expect_said(words(SearchReason::kUnfinished), {"work was used up"});
}

}  // namespace
}  // namespace lasso::mdat
