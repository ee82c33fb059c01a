#include "mdat/campaign/report.hpp"

#include <gtest/gtest.h>

#include "mdat/campaign/summary_text.hpp"
#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string html_of(const CampaignSource& campaign, const ResultTable& table) {
  Plotter plotter(testing::TempDir());
  const std::string html = campaign_html(plotter, find(campaign, table, "out/rough"), "Box <1>");
  EXPECT_EQ(plotter.missing(), "");
  return html;
}

void expect_in(const std::string& html, const std::string& part) { EXPECT_NE(html.find(part), std::string::npos) << part; }

TEST(CampaignReport, HasVerdictsCausesAndCommands) {
  VERIFIES("LASSO-GND-057~1");
  test::MixedCampaign mixed;
  mixed.campaign.dispersions = {{{"truth.range_m"}, NumberLaw(Uniform{2, 6})}};
  const std::string html = html_of(mixed.campaign, mixed.table);
  expect_in(html, "Box &lt;1&gt;, scenario <b>spin</b>: 40 cases; 1 failed to run");
  expect_in(html, "<td>no_wrong_pose</td><td><span class='good'>met</span></td><td>wrong ≤ 0 in at least 80 %</td><td>39 of 40</td>");
  expect_in(html, "<td>precise</td><td><span class='bad'>failed</span></td>");
  expect_in(html, "<td>39</td><td><code>mdat campaign case out/rough 39</code></td><td>rms_mm 5.9</td>");
  expect_in(html, "<td>3</td><td><code>mdat campaign case out/rough 3</code></td><td>worker ended, by &quot;signal&quot; 11</td>");
  expect_in(html, "<td>truth.range_m</td><td>+0.76</td><td>p &lt; 0.001</td><td>worse where it is larger</td>");
  expect_in(html, "<td>truth.range_m</td><td>uniform, 2 to 6</td>");
  EXPECT_EQ(html, html_of(mixed.campaign, mixed.table));
}

TEST(CampaignReport, HasAPageForWhateverIsThere) {
  VERIFIES("LASSO-GND-057~1");
  test::MixedCampaign mixed;
  ResultTable one = mixed.table, failed = mixed.table, bare = mixed.table, none = mixed.table;
  one.rows.resize(1);
  none.rows.clear();
  for (CaseRow& row : failed.rows) row = {row.number, "failed:refused", {test::kNoNumber, test::kNoNumber}, row.drawn};
  bare.columns.clear();
  for (CaseRow& row : bare.rows) row.drawn.clear();
  expect_in(html_of(mixed.campaign, one), "<td>1 of 1</td><td>100 %</td>");
  expect_in(html_of(mixed.campaign, failed), "Nothing to draw: no case has this figure.");
  expect_in(html_of(mixed.campaign, bare), "cases differ by their seed alone");
  expect_in(html_of(mixed.campaign, none), "No case was flown.");
}

TEST(CampaignReport, ShowsFiguresWithoutCriteria) {
  VERIFIES("LASSO-GND-057~1");
  test::MixedCampaign mixed;
  mixed.campaign.criteria.clear();
  mixed.table.figures = {"lost", "worst_mm"};
  const std::string html = html_of(mixed.campaign, mixed.table);
  expect_in(html, "The campaign has no criteria, so there is no verdict.");
  expect_in(html, "<h2>worst_mm</h2>");
  EXPECT_EQ(html.find("A criterion is met if"), std::string::npos);
}

TEST(CampaignReport, HasTimesToAlertAndTheStanfordDiagram) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const std::string html = html_of(test::campaign_of({}), test::table_with_counts());
  expect_in(html, "<h2>Integrity</h2>");
  expect_in(html, "<dt>valid and wrong</dt><dd>2 of 300, 0.080 % to 2.4 %; 1 episode; flights with one: 1 of 3, 0.84 % to 90.6 %</dd>");
  expect_in(html, "error = level");
  expect_in(html_of(test::campaign_of({}), test::table_of({1})), kNoCounts);
}

}  // namespace
}  // namespace lasso::mdat
