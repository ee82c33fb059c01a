#include "mdat/campaign/summary_text.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kShownCases = 5, kShownCorrelations = 3;

using Lines = std::vector<std::vector<std::string>>;

std::string verdict_lines(const Findings& all) {
  Lines lines = {{"criterion", "asks for", "cases within", "share", "limits of the share", "verdict"}};
  for (const Finding& finding : all.findings) {
    const Conclusion& one = finding.conclusion;
    lines.push_back({one.criterion.name, criterion_text(one.criterion), format("%u of %u", one.within, one.cases), share_text(one.share()),
                     limits_text(one.limits) + format(" (%g %%)", 100 * one.criterion.confidence), to_string(one.verdict)});
  }
  std::string text = aligned_text(lines);
  for (const Finding& finding : all.findings) {
    for (const std::string& more : {unknown_text(finding.conclusion), what_decides(finding.conclusion)})
      text += more.empty() ? "" : "  " + finding.conclusion.criterion.name + ": " + more + "\n";
  }
  return text;
}

std::string worst_lines(const Findings& all) {
  Lines lines;
  for (const Finding& finding : all.findings) {
    for (std::size_t i = 0; i < std::min(kShownCases, finding.worst.size()); ++i) {
      const CaseRow& row = all.table.rows[finding.worst[i]];
      const bool within = is_within(finding.conclusion.criterion, row, finding.figure);
      lines.push_back({i == 0 ? finding.conclusion.criterion.name : "", case_text(all, finding, finding.worst[i]),
                       within ? "within" : "outside", case_command(all, row.number)});
    }
  }
  return lines.empty() ? "" : "Worst cases, and how to fly them again\n" + aligned_text(lines);
}

std::string failed_lines(const Findings& all) {
  Lines lines;
  for (const std::size_t place : failed_cases(all.table, kShownCases)) {
    const CaseRow& row = all.table.rows[place];
    lines.push_back({reason_text(row), case_command(all, row.number)});
  }
  return lines.empty() ? "" : "Cases that failed to run\n" + aligned_text(lines);
}

void add_correlations(const Findings& all, const Finding& finding, Lines& lines) {
  std::size_t shown = 0;
  for (const Correlation& one : finding.correlations) {
    if (one.probability >= kSignificance || shown == kShownCorrelations) continue;
    lines.push_back({shown++ == 0 ? finding.conclusion.criterion.name : "", one.rho > 0 ? "worse where larger:" : "worse where smaller:",
                     all.table.columns[one.column], format("%+.2f", one.rho), probability_text(one.probability)});
  }
}

std::string correlation_lines(const Findings& all) {
  Lines lines;
  for (const Finding& finding : all.findings) add_correlations(all, finding, lines);
  if (all.findings.empty() || all.table.columns.empty()) return "";
  return lines.empty() ? "No drawn value goes with bad cases (rank correlations, 5 % level).\n"
                       : "What goes with bad cases: rank correlations, p over all drawn values\n" + aligned_text(lines);
}

std::string integrity_lines(const Findings& all) {
  if (!all.integrity) return std::string(kNoCounts) + "\n";
  return "Integrity\n" + aligned_text(integrity_list(*all.integrity));
}

}  // namespace

std::string probability_text(double probability) { return probability < 0.001 ? "p < 0.001" : format("p = %.2g", probability); }

std::string summary_text(const Findings& all) {
  std::string text = "Campaign " + all.campaign.name + ", scenario " + all.campaign.scenario + ": " + cases_text(all) + "\n";
  text += all.findings.empty() ? "It has no criteria, so there is no verdict.\n" : verdict_lines(all);
  for (const std::string& part : {integrity_lines(all), failed_lines(all), worst_lines(all), correlation_lines(all)})
    text += part.empty() ? "" : "\n" + part;
  return text;
}

}  // namespace lasso::mdat
