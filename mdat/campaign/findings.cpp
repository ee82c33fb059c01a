#include "mdat/campaign/findings.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kWorstCases = 10;

}  // namespace

Findings find(const CampaignSource& campaign, const ResultTable& table, const std::string& folder) {
  Findings all{campaign, table, folder, 0, campaign.look_every > 0 && table.rows.size() < campaign.cases, {}};
  for (const CaseRow& row : table.rows) all.not_run += row.has_run() ? 0U : 1U;
  for (const Conclusion& conclusion : conclude(campaign, table)) {
    const std::size_t figure = figure_of(conclusion.criterion, table);
    all.findings.push_back({conclusion, figure, worst_cases(conclusion.criterion, table, figure, kWorstCases),
                            correlations(conclusion.criterion, table, figure)});
  }
  return all;
}

std::string case_command(const Findings& all, std::uint32_t number) {
  return "mdat campaign case " + shell_word(all.folder) + format(" %u", number);
}

std::string case_text(const Findings& all, const Finding& finding, std::size_t row) {
  const CaseRow& one = all.table.rows[row];
  const std::string& name = all.table.figures[finding.figure];
  if (!one.has_run()) return "failed: " + one.status.substr(std::min(one.status.size(), one.status.find(':') + 1));
  const double value = one.figures[finding.figure];
  return std::isnan(value) ? "no " + name : name + format(" %.4g", value);
}

std::string cases_text(const Findings& all) {
  const std::size_t flown = all.table.rows.size();
  std::string text = format("%zu", flown);
  if (flown < all.campaign.cases) text += format(" of %s%u", all.campaign.look_every > 0 ? "at most " : "", all.campaign.cases);
  text += text == "1" ? " case" : " cases";
  if (all.stopped) text += ", as its rule stopped it";
  return all.not_run == 0 ? text : text + format("; %u failed to run", all.not_run);
}

}  // namespace lasso::mdat
