#include "mdat/campaign/summary_files.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(ResultsCsv, HasEveryFigureAndDrawnValue) {
  VERIFIES("LASSO-GND-058~1");
  ResultTable table{{"wrong", "rms_mm"}, {"truth.range_m"}, {}};
  table.rows.push_back({0, "ok", {0, 0.1}, {1e-5}});
  table.rows.push_back({2, "failed:a \"b\", c", {test::kNoNumber, test::kNoNumber}, {1.0 / 3}});
  EXPECT_EQ(results_csv(table),
            "case,status,wrong,rms_mm,truth.range_m\n0,ok,0,0.1,1e-05\n2,\"failed:a \"\"b\"\", c\",,,0.3333333333333333\n");
}

TEST(SummaryJson, SaysWhatWasConcluded) {
  VERIFIES("LASSO-GND-058~1");
  const test::MixedCampaign mixed;
  const auto json = nlohmann::json::parse(summary_json(find(mixed.campaign, mixed.table, "d")));
  EXPECT_EQ(json["cases"], 40);
  EXPECT_EQ(json["failed_to_run"], 1);
  const auto& precise = json["criteria"].at(1);
  EXPECT_EQ(precise["verdict"], "failed");
  EXPECT_EQ(precise["within"], 19);
  EXPECT_EQ(precise["without_figure"], 1);
  EXPECT_TRUE(precise["at_least"].is_null());
  EXPECT_EQ(precise["at_most"], 4);
  EXPECT_EQ(precise["limits_by"], "Clopper-Pearson");
  EXPECT_EQ(precise["worst_cases"].at(0), 5);
  EXPECT_EQ(precise["worst_cases"].at(1), 39);
  EXPECT_EQ(precise["rank_correlations"].at(0)["column"], "truth.range_m");
}

TEST(SummaryJson, HasTimesToAlertAndProtectionLevelsWhereTheyWereKept) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const CampaignSource campaign = test::campaign_of({});
  const ResultTable table = test::table_with_counts(), old = test::table_of({1});
  const auto json = nlohmann::json::parse(summary_json(find(campaign, table, "d")));
  EXPECT_EQ(json["time_to_alert"]["worst_s"], 0.4);
  EXPECT_EQ(json["time_to_alert"]["flights"], 3);
  EXPECT_EQ(json["time_to_alert"]["wrong_flights"], 1);
  EXPECT_EQ(json["protection"]["misleading"], 2);
  const auto earlier = nlohmann::json::parse(summary_json(find(campaign, old, "d")));
  EXPECT_TRUE(earlier["time_to_alert"].is_null() && earlier["protection"].is_null());
}

TEST(Junit, FailsWhatIsNotMetAndNamesTheWorstCases) {
  VERIFIES("LASSO-GND-058~1");
  const test::MixedCampaign mixed;
  const std::string text = junit_xml(find(mixed.campaign, mixed.table, "out/rough"));
  const auto expect = [&](const char* part) { EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text; };
  expect("<testsuite name=\"campaign.rough\" tests=\"3\" failures=\"1\" errors=\"1\" time=\"0\" skipped=\"0\">");
  expect("<testcase classname=\"campaign.rough\" name=\"no_wrong_pose\" time=\"0\"/>");
  expect("<failure type=\"failed\" message=\"rms_mm &lt;= 4 in at least 90 %: failed, 19 of 40 cases\">");
  expect("\nrms_mm 5.9: mdat campaign case out/rough 39\n");
  expect("<error type=\"failed to run\" message=\"1 of 40 cases failed to run\">worker ended, by &quot;signal&quot; 11: mdat");
}

TEST(Junit, HoldsWhatAWorkerLeaves) {
  VERIFIES("LASSO-GND-058~1");
  test::MixedCampaign mixed;
  mixed.table.rows[3].status = "failed:<bell\a>";
  const std::string text = junit_xml(find(mixed.campaign, mixed.table, "d"));
  EXPECT_NE(text.find("&lt;bell &gt;: mdat"), std::string::npos) << text;
}

// A part of a campaign does not pass, whatever its criteria say.
TEST(Junit, IsAnErrorWhereCasesAreMissing) {
  VERIFIES("LASSO-GND-058~1");
  CampaignSource campaign = test::campaign_of({});
  campaign.cases = 3;
  const ResultTable table = test::table_of({1});
  const std::string text = junit_xml(find(campaign, table, "d"));
  EXPECT_NE(text.find("errors=\"1\""), std::string::npos) << text;
  EXPECT_NE(text.find("message=\"2 of 3 cases are missing\""), std::string::npos) << text;
  EXPECT_FALSE(nlohmann::json::parse(summary_json(find(campaign, table, "d"))).at("complete"));
}

TEST(Junit, HasATestCaseEvenWithoutCriteria) {
  VERIFIES("LASSO-GND-058~1");
  const CampaignSource campaign = test::campaign_of({});
  const ResultTable table = test::table_of({1});
  const std::string text = junit_xml(find(campaign, table, "d"));
  EXPECT_NE(text.find("tests=\"1\" failures=\"0\" errors=\"0\""), std::string::npos) << text;
}

}  // namespace
}  // namespace lasso::mdat
