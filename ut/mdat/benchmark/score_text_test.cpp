#include "mdat/benchmark/score_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mdat/common/limits.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

BenchmarkSet some_set() {
  BenchmarkSet set;
  set.protocol.plan = {2001, 2, 10, SensorKind::kTimeOfFlight, 10};
  return set;
}

Score some_score(const std::string& program, bool covariances) {
  Score score;
  score.program = program;
  score.covariances = covariances;
  score.counts = {20, 17, 1, 16, 12, 1, 1, 2};
  score.missing = 2;
  score.nees_median = covariances ? 6.25 : kNan;
  score.nees_worst = covariances ? 30.5 : kNan;
  score.nees_worst_body = covariances ? "body_2002" : "";
  score.timed = covariances ? 18 : 0;
  score.time = {15000, 45000, 50000};
  score.bodies = {{"body_2001", "rock", "a rock", 3.2, {10, 10, 0, 8, 8, 0, 0, 0}, kNan},
                  {"body_2002", "plain", "a \"box\"", 1.5, {10, 7, 1, 8, 4, 1, 1, 2}, covariances ? 30.5 : kNan}};
  score.worst_body = 1;
  score.scans = {{"body_2001", "s01", true, ScanVerdict::kRight, {5, 0.001, 0.002}},
                 {"body_2001", "s02", false, ScanVerdict::kRefused, {}},
                 {"body_2002", "s01", true, ScanVerdict::kWrong, {covariances ? 90 : kNan, 0.5, kRadPerDeg}}};
  return score;
}

TEST(ScoreText, SaysSharesWithExactLimitsAndNamesTheWorstBody) {
  VERIFIES("LASSO-GND-122~1");
  const std::string text = scores_text(some_set(), {some_score("mine", true), some_score("other", false)});
  for (const char* said :
       {"benchmark of 2 bodies from seed 2001 on, 10 scans each by LIDAR; starts 10 deg and 0.1 of the size off\n",
        "20 scans, of which 16 determine the pose\n", "right, of 16", "wrong and valid, of 20", "refused, of 16",
        "12 (75.0 %; 47.6 % to 92.8 %)", "1 (5.0 %; 0.12 % to 24.9 %)", "2 (12.5 %; 1.5 % to 38.4 %)", "6.25, 30.5 (body_2002)", "15, 45\n",
        "unknown", "  mine: body_2002 (plain, 1.5 m): 1 of 10 wrong; of 8 determined 4 right, 2 refused; NEES 30.5\n",
        "  mine: 2 scans without a row: refused\n", "  mine: 1 determined scan neither right nor wrong",
        "  no covariance: other: ", "exact limits at 95 %"})
    EXPECT_NE(text.find(said), std::string::npos) << said << "\n" << text;
}

TEST(ScoreText, JsonHasAllBodiesAndNullForWhatIsUnknown) {
  VERIFIES("LASSO-GND-122~1");
  const Json json = Json::parse(scores_json(some_set(), {some_score("mine", true), some_score("other", false)}));
  EXPECT_EQ(json.at("set").at("seed"), 2001);
  EXPECT_EQ(json.at("set").at("sensor"), "lidar");
  const Json &mine = json.at("programs").at(0), &other = json.at("programs").at(1);
  EXPECT_EQ(mine.at("right").at("count"), 12);
  EXPECT_EQ(mine.at("right").at("of"), 16);
  EXPECT_DOUBLE_EQ(mine.at("right").at("limits").at(0), share_limits(12, 16, 0.95).lower);
  EXPECT_EQ(mine.at("nees").at("worst_body"), "body_2002");
  EXPECT_DOUBLE_EQ(mine.at("time").at("p99_s"), 0.045);
  EXPECT_EQ(mine.at("bodies").at(1).at("what"), "a \"box\"");
  EXPECT_TRUE(mine.at("bodies").at(0).at("nees").is_null());
  EXPECT_EQ(mine.at("worst_body"), "body_2002");
  EXPECT_TRUE(other.at("nees").at("median").is_null());
  EXPECT_TRUE(other.at("time").is_null());
}

TEST(ScoreText, CsvHasARowAScan) {
  VERIFIES("LASSO-GND-122~1");
  EXPECT_EQ(scores_csv({some_score("mine", true), some_score("other", false)}),
            "program,body,scan,determined,verdict,error_m,error_deg,squared\n"
            "mine,body_2001,s01,1,right,0.001,0.114592,5\n"
            "mine,body_2001,s02,0,refused,,,\n"
            "mine,body_2002,s01,1,wrong,0.5,1,90\n"
            "other,body_2001,s01,1,right,0.001,0.114592,5\n"
            "other,body_2001,s02,0,refused,,,\n"
            "other,body_2002,s01,1,wrong,0.5,1,\n");
}

TEST(ScoreText, OfNothingDeterminedThereIsNoShare) {
  VERIFIES("LASSO-GND-122~1");
  Score score = some_score("mine", true);
  score.counts = {20, 17, 1, 0, 0, 0, 0, 0};
  EXPECT_NE(scores_text(some_set(), {score}).find("none"), std::string::npos);
  EXPECT_TRUE(Json::parse(scores_json(some_set(), {score})).at("programs").at(0).at("right").at("share").is_null());
}

}  // namespace
}  // namespace lasso::mdat
