#include "mdat/campaign/report.hpp"

#include <algorithm>
#include <limits>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/campaign/figures.hpp"
#include "mdat/campaign/law_text.hpp"
#include "mdat/campaign/pictures.hpp"
#include "mdat/campaign/summary_text.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/report/page.hpp"
#include "mdat/report/stanford_view.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kTableColumns = 4, kListedFailures = 20;
constexpr const char* kShownFigures[] = {"worst_mm", "worst_deg", "lost"};  // of a campaign without criteria

// Text of others on the page, with signs as a book has them.
std::string html_text(const std::string& text) {
  std::string html = escape(text);
  for (const auto& [sign, mark] : {std::pair<std::string, std::string>{"&lt;=", "≤"}, {"&gt;=", "≥"}}) {
    for (std::size_t place = html.find(sign); place != std::string::npos; place = html.find(sign)) html.replace(place, sign.size(), mark);
  }
  return html;
}

std::string verdict_html(Verdict verdict) {
  constexpr const char* kClasses[] = {"good", "bad", "partly"};
  return format("<span class='%s'>%s</span>", kClasses[static_cast<std::size_t>(verdict)], to_string(verdict));
}

std::string code(const std::string& text) { return "<code>" + escape(text) + "</code>"; }

std::string verdict_section(const Findings& all) {
  if (all.findings.empty())
    return "<section>\n<h2>Verdicts</h2>\n<p class='note'>The campaign has no criteria, so there is no verdict.</p>\n</section>\n";
  HtmlTable html{{"criterion", "verdict", "asks for", "cases within", "share", "limits of the share", "confidence"}, {}, true};
  std::string more;
  for (const Finding& finding : all.findings) {
    const Conclusion& one = finding.conclusion;
    html.rows.push_back({escape(one.criterion.name), verdict_html(one.verdict), html_text(criterion_text(one.criterion)),
                         format("%u of %u", one.within, one.cases), share_text(one.share()), limits_text(one.limits),
                         format("%g %%", 100 * one.criterion.confidence)});
    for (const std::string& text : {unknown_text(one), what_decides(one)})
      more += text.empty() ? "" : "<dt>" + escape(one.criterion.name) + "</dt><dd>" + escape(text) + "</dd>\n";
  }
  return "<section>\n<h2>Verdicts</h2>\n" + to_html(html) + (more.empty() ? "" : "<dl>\n" + more + "</dl>\n") + "</section>\n";
}

// What went wrong, the values that matter most, the command.
std::string worst_table(const Findings& all, const Finding& finding) {
  if (finding.worst.empty()) return "";
  const std::size_t columns = std::min(kTableColumns, finding.correlations.size());
  HtmlTable html{{"worst cases", "to fly it again", finding.conclusion.criterion.figure, all.findings.empty() ? "" : "is"}, {}};
  for (std::size_t i = 0; i < columns; ++i) html.head.push_back(escape(all.table.columns[finding.correlations[i].column]));
  for (const std::size_t row : finding.worst) {
    const CaseRow& one = all.table.rows[row];
    const bool within = is_within(finding.conclusion.criterion, one, finding.figure);
    std::vector<std::string> cells = {format("%u", one.number), code(case_command(all, one.number)), escape(case_text(all, finding, row)),
                                      all.findings.empty() ? ""
                                      : within             ? "within"
                                                           : "<span class='bad'>outside</span>"};
    for (std::size_t i = 0; i < columns; ++i) cells.push_back(format("%.4g", one.drawn[finding.correlations[i].column]));
    html.rows.push_back(cells);
  }
  return to_html(html);
}

std::string correlation_table(const Findings& all, const Finding& finding) {
  if (finding.correlations.empty()) return "";
  HtmlTable html{{"drawn value", "rank correlation", "p", "cases are"}, {}, true};
  for (const Correlation& one : finding.correlations) {
    const bool sure = one.probability < kSignificance;
    html.rows.push_back({escape(all.table.columns[one.column]), format("%+.2f", one.rho), escape(probability_text(one.probability)),
                         !sure         ? "–"
                         : one.rho > 0 ? "worse where it is larger"
                                       : "worse where it is smaller"});
  }
  return "<details><summary>Rank correlations of all drawn values with being worse</summary>" + to_html(html) +
         "<p class='note'>Spearman's; p: the chance of one like it where nothing depends on the value, corrected for the number of values "
         "(Holm).</p></details>\n";
}

// Said of a picture of drawn values that may have nothing to do with bad cases.
std::string by_chance(const Finding& finding) {
  return finding.correlations[0].probability < kSignificance ? "" : "None of the drawn values goes with bad cases more than by chance. ";
}

std::string pictures(Plotter& plotter, const Findings& all, const Finding& finding) {
  const bool two = has_pair(all.table, finding);
  std::string html = figure(distribution_picture(plotter, all.table, finding),
                            std::string(two ? "Left: the" : "The") +
                                " share of cases whose figure is not above each value; dashed, the bound. Cases without "
                                "a figure are missing at the top." +
                                (two ? " Right: all cases over the two drawn values that go with bad cases most." : ""));
  if (finding.correlations.empty()) return html;
  return html +
         figure(columns_picture(plotter, all.table, finding),
                by_chance(finding) +
                    format("The figure over the drawn values that go with bad cases most, and the share of cases outside in parts of "
                           "their ranges, with "
                           "limits of 95 %%. Of more than %zu cases of a kind an even selection is drawn.",
                           kShownPoints));
}

std::string finding_section(Plotter& plotter, const Findings& all, const Finding& finding) {
  const Criterion& criterion = finding.conclusion.criterion;
  const bool asked = !all.findings.empty();
  const std::string title = escape(criterion.name) + (asked ? ": " + verdict_html(finding.conclusion.verdict) : "");
  std::string html = "<section>\n<h2>" + title + "</h2>\n";
  if (asked) html += "<p>" + html_text(conclusion_text(finding.conclusion)) + "</p>\n";
  for (const Figure& figure : case_figures())
    html += figure.name == criterion.figure ? "<p class='note'>" + code(criterion.figure) + ": " + escape(figure.meaning) + ".</p>\n" : "";
  return html + worst_table(all, finding) + pictures(plotter, all, finding) + correlation_table(all, finding) + "</section>\n";
}

// Of a campaign without criteria: figures that a person asks for first, without bounds.
std::vector<Finding> shown_findings(const Findings& all) {
  if (!all.findings.empty()) return all.findings;
  std::vector<Finding> shown;
  for (const char* name : kShownFigures) {
    if (std::find(all.table.figures.begin(), all.table.figures.end(), name) == all.table.figures.end()) continue;
    Conclusion conclusion;
    conclusion.criterion = {name, name, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 1, 0.95};
    shown.push_back(finding_of(conclusion, all.table));
  }
  return shown;
}

std::string failures_section(const Findings& all) {
  if (all.not_run == 0) return "";
  HtmlTable html{{"case", "to fly it again", "why"}, {}, true};
  for (const std::size_t place : failed_cases(all.table, kListedFailures)) {
    const CaseRow& row = all.table.rows[place];
    html.rows.push_back({format("%u", row.number), code(case_command(all, row.number)), escape(reason_text(row))});
  }
  const std::string first = all.not_run > kListedFailures ? format(", the first %zu", kListedFailures) : "";
  return format("<section>\n<h2>%u case%s failed to run%s</h2>\n", all.not_run, all.not_run == 1 ? "" : "s", first.c_str()) +
         to_html(html) + "</section>\n";
}

std::string drawn_section(const Findings& all) {
  std::string html = "<section>\n<h2>What was drawn</h2>\n";
  if (all.campaign.dispersions.empty()) return html + "<p class='note'>Nothing: cases differ by their seed alone.</p>\n</section>\n";
  HtmlTable table{{"value", "law"}, {}, true};
  for (const Dispersion& dispersion : all.campaign.dispersions) {
    std::string names;
    for (const std::string& column : dispersion.columns) names += (names.empty() ? "" : "<br>") + escape(column);
    table.rows.push_back({names, escape(law_text(dispersion.law))});
  }
  return html + to_html(table) + "</section>\n";
}

LevelPoints points_of(const CaseCounts& counts) {
  LevelPoints points;
  for (const LevelCounts::Cell& cell : counts.position_m.cells())
    points.position_mm.push_back({1e3 * cell.level, 1e3 * cell.error, static_cast<double>(cell.poses), cell.misleading});
  for (const LevelCounts::Cell& cell : counts.attitude_rad.cells())
    points.attitude_deg.push_back({cell.level / kRadPerDeg, cell.error / kRadPerDeg, static_cast<double>(cell.poses), cell.misleading});
  return points;
}

std::string integrity_of_cases(Plotter& plotter, const Findings& all) {
  std::string html = "<section>\n<h2>Integrity</h2>\n";
  if (!all.integrity || !all.table.counts) return html + "<p class='note'>" + escape(kNoCounts) + "</p>\n</section>\n";
  html += "<dl>\n";
  for (const std::vector<std::string>& line : integrity_list(*all.integrity))
    html += "<dt>" + escape(line[0]) + "</dt><dd>" + html_text(line[1]) + "</dd>\n";
  html += "</dl>\n<p class='note'>" + escape(kIntegrityNote) + " Medians of levels are known to within 4.5 %.</p>\n";
  return html +
         figure(stanford_diagram(plotter, points_of(*all.table.counts)),
                std::string(kStanfordLegend) +
                    " A point stands for the poses of a cell, 9 % wide in the level and 19 % in error over "
                    "level; its shade says how many there are.") +
         "</section>\n";
}

std::string how_decided(const CampaignSource& campaign) {
  std::string text =
      "A criterion is met if the lower limit of the share of cases within its bounds is at least what it asks for, and failed if the upper "
      "one is "
      "below. Each criterion has its confidence for itself. The limits are ";
  text += campaign.look_every == 0
              ? "those of Clopper and Pearson, exact for a number of cases that was fixed before."
              : format(
                    "those of a confidence sequence, which hold at all looks together: one after every %u cases. The share "
                    "itself is a little too far from what is asked for, as the campaign ends when it happens to be.",
                    campaign.look_every);
  if (campaign.sampling == Sampling::kRandom) return text;
  return text +
         " They take cases as independent. This sampling covers the ranges more evenly, so that the share mostly varies less than they "
         "say; "
         "their confidence is not proven for it.";
}

std::string introduction_of(const Findings& all, const std::string& mission) {
  constexpr const char* kSamplingWords[] = {"random", "a Latin hypercube", "a Sobol sequence"};
  const CampaignSource& campaign = all.campaign;
  std::string html = "<h1>Campaign " + escape(campaign.name) + "</h1>\n<p class='lead'>" + escape(mission) + ", scenario <b>" +
                     escape(campaign.scenario) + "</b>: " + escape(cases_text(all)) +
                     format(". Sampling: %s, seed %llu. mdat %s.</p>\n", kSamplingWords[static_cast<std::size_t>(campaign.sampling)],
                            static_cast<unsigned long long>(campaign.seed), kVersion);
  return all.findings.empty() ? html : html + "<p class='note'>" + how_decided(campaign) + "</p>\n";
}

}  // namespace

std::string campaign_html(Plotter& plotter, const Findings& all, const std::string& mission) {
  std::string body = introduction_of(all, mission) + verdict_section(all) + failures_section(all);
  for (const Finding& finding : shown_findings(all)) body += finding_section(plotter, all, finding);
  return page("Campaign " + all.campaign.name + ", " + mission, body + integrity_of_cases(plotter, all) + drawn_section(all));
}

}  // namespace lasso::mdat
