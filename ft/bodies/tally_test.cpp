#include "ft/bodies/tally.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::bodies {
namespace {

Trial trial(std::size_t number, bool determined, bool valid, double squared, double translation_m) {
  Trial trial;
  trial.number = number;
  trial.determined = determined;
  trial.valid = valid;
  trial.reason = valid ? "valid" : "unchecked";
  trial.error = {squared, translation_m, 0};
  return trial;
}

TEST(Tally, CountsWhatItIsGiven) {
  VERIFIES("LASSO-GND-114~1");
  Tally tally;
  tally.numbers = 3;
  tally.add(trial(0, true, true, 4, 0), 1);
  tally.add(trial(0, true, false, 900, 1), 1);     // not valid: nobody is misled
  tally.add(trial(1, true, true, 30, 0.02), 1);    // wrong
  tally.add(trial(1, false, true, 400, 0.5), 1);   // wrong, though no scan could tell
  tally.add(trial(2, false, true, 400, 0.01), 1);  // near enough
  EXPECT_EQ(tally.trials, 5u);
  EXPECT_EQ(tally.valid, 4u);
  EXPECT_EQ(tally.determined, 3u);
  EXPECT_EQ(tally.determined_valid, 2u);
  EXPECT_EQ(tally.wrong, 2u);
  EXPECT_EQ(tally.wrong_numbers, 1u);
  EXPECT_EQ(tally.reasons.at("unchecked"), 1u);
  EXPECT_DOUBLE_EQ(tally.nees, (4 + 30 + 400 + 400) / 4.0);
  EXPECT_DOUBLE_EQ(tally.worst, 400);
}

TEST(Tally, CountsMisleadingPosesAndTimesToAlert) {
  VERIFIES("LASSO-GND-130~1");
  VERIFIES("LASSO-GND-131~1");
  std::vector<Row> rows(2);
  Trial far = trial(0, true, true, 4, 0.02), near = far, invalid = trial(0, true, false, 4, 0.02), turned = near;
  far.level = invalid.level = {0.01, 1};
  near.level = turned.level = {0.03, 0.1};
  turned.error.rotation_rad = 0.2;
  for (const Trial& one : {far, near, invalid, turned}) rows[0].tally.add(one, 1);
  EXPECT_EQ(rows[0].tally.misleading, 2u);
  EXPECT_NE(summary_text("track", rows).find("time to alert:         no wrong pose, at most 63.2 % of valid ones\n"), std::string::npos)
      << summary_text("track", rows);
  rows[0].tally.alert.add(mdat::wrong_episodes({{0, true}, {0.2, true}, {0.4, false}, {0.6, true}}, 0.8));
  rows[1].tally.alert.add(mdat::wrong_episodes({{0, true}, {0.2, false}}, 0.4));
  const std::string text = summary_text("track", rows);
  EXPECT_NE(text.find("time to alert:         median 0.2 s, 95 % 0.4 s, worst 0.4 s of 3 episodes, 1 of which the flight's end cut\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("misleading:            2 of 3 (66.7 %, 9.43 to 99.2 %)"), std::string::npos) << text;
  EXPECT_EQ(summary_text("start", rows).find("time to alert"), std::string::npos) << "a single scan has none";
  EXPECT_NE(table_csv(rows).find(",2,1,0.4,2,"), std::string::npos) << table_csv(rows);
}

TEST(Tally, SummaryHasExactLimitsAndTheWorstBodyFirst) {
  VERIFIES("LASSO-GND-114~1");
  std::vector<Row> rows(3);
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].seed = 7 + i;
    rows[i].kind = "plain";
    rows[i].tally.numbers = 1;
    for (int k = 0; k < 10; ++k) rows[i].tally.add(trial(0, true, true, i == 1 && k == 0 ? 30 : 6, i == 1 ? 0.1 : 0), 1);
  }
  const std::string text = summary_text("track", rows);
  EXPECT_NE(text.find("worst bodies:\n      8 plain"), std::string::npos) << text;
  EXPECT_NE(text.find("valid and wrong:       1 of 30 (3.33 %, 0.0844 to 17.2 %); in 1 of 3 (33.3 %, 0.84 to 90.6 %), of 1 bodies"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("determined and valid:  30 of 30 (100 %, 88.4 to 100 %); 0 bodies below 90 %"), std::string::npos) << text;
  EXPECT_NE(wrong_csv(rows).find("\n8,0,0,"), std::string::npos);
  EXPECT_NE(table_csv(rows).find("\n8,plain,"), std::string::npos);
}

}  // namespace
}  // namespace lasso::bodies
