#include "mdat/campaign/findings.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kWorstCases = 10;

// A figure of each case that has run, where there is one.
std::vector<double> values_of(const ResultTable& table, const char* figure) {
  std::vector<double> values;
  const auto place = static_cast<std::size_t>(std::find(table.figures.begin(), table.figures.end(), figure) - table.figures.begin());
  for (const CaseRow& row : table.rows) {
    if (place < table.figures.size() && row.has_run() && !std::isnan(row.figures[place])) values.push_back(row.figures[place]);
  }
  return values;
}

std::size_t counted(const ResultTable& table, const char* figure) {
  double sum = 0;
  for (const double value : values_of(table, figure)) sum += value;
  return static_cast<std::size_t>(sum);
}

double largest(const ResultTable& table, const char* figure) {
  const std::vector<double> values = values_of(table, figure);
  return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
}

// Cases that were flown and in which no pose was ever valid.
std::size_t never_valid(const ResultTable& table) {
  const auto valid = static_cast<std::size_t>(std::find(table.figures.begin(), table.figures.end(), "valid") - table.figures.begin());
  if (valid == table.figures.size()) return 0;
  const auto is_never = [&](const CaseRow& row) { return row.has_run() && row.figures[valid] == 0; };
  return static_cast<std::size_t>(std::count_if(table.rows.begin(), table.rows.end(), is_never));
}

// Which columns are components of vectors, by the vectors' names.
std::map<std::string, std::vector<std::size_t>> vectors_of(const std::vector<std::string>& columns) {
  std::map<std::string, std::vector<std::size_t>> vectors;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& name = columns[i];
    const std::string end = name.substr(name.size() - std::min<std::size_t>(2, name.size()));
    if (end == ".x" || end == ".y" || end == ".z") vectors[name.substr(0, name.size() - 2)].push_back(i);
  }
  std::erase_if(vectors, [](const auto& vector) { return vector.second.size() < 2; });
  return vectors;
}

double length_of(const CaseRow& row, const std::vector<std::size_t>& components) {
  double square = 0;
  for (const std::size_t i : components) square += row.drawn[i] * row.drawn[i];
  return std::sqrt(square);
}

}  // namespace

ResultTable with_lengths(ResultTable table) {
  for (const auto& [name, components] : vectors_of(table.columns)) {
    table.columns.push_back("|" + name + "|");
    for (CaseRow& row : table.rows) row.drawn.push_back(length_of(row, components));
  }
  return table;
}

std::optional<Integrity> integrity_of(const ResultTable& table) {
  if (!table.counts) return std::nullopt;
  Integrity all;
  all.alert = table.counts->alert.statistics();
  all.wrong = counted(table, "wrong");
  all.protection.poses = table.counts->position_m.poses();
  all.protection.misleading = counted(table, "misleading");
  all.protection.position_mm = {table.counts->position_m.misleading(), 1e3 * table.counts->position_m.median(),
                                largest(table, "level_worst_mm")};
  all.protection.attitude_deg = {table.counts->attitude_rad.misleading(), table.counts->attitude_rad.median() / kRadPerDeg,
                                 largest(table, "level_worst_deg")};
  for (const double wrong : values_of(table, "wrong")) {
    ++all.flights;
    all.wrong_flights += wrong > 0 ? 1U : 0U;
  }
  return all;
}

std::string reason_text(const CaseRow& row) { return row.status.substr(std::min(row.status.size(), row.status.find(':') + 1)); }

Finding finding_of(const Conclusion& conclusion, const ResultTable& table) {
  const std::size_t figure = figure_of(conclusion.criterion, table);
  return {conclusion, figure, worst_cases(conclusion.criterion, table, figure, kWorstCases),
          correlations(conclusion.criterion, table, figure)};
}

Findings find(const CampaignSource& campaign, const ResultTable& table, const std::string& folder) {
  const bool stopped = table.rows.size() < campaign.cases && stop_at(campaign, table) == table.rows.size();
  Findings all{campaign, with_lengths(table), folder, 0, stopped, {}, integrity_of(table)};
  for (const CaseRow& row : table.rows) all.not_run += row.has_run() ? 0U : 1U;
  for (const Conclusion& conclusion : conclude(campaign, table)) all.findings.push_back(finding_of(conclusion, all.table));
  return all;
}

std::string case_command(const Findings& all, std::uint32_t number) {
  return "mdat campaign case " + shell_word(all.folder) + format(" %u", number);
}

std::string case_text(const Findings& all, const Finding& finding, std::size_t row) {
  const CaseRow& one = all.table.rows[row];
  const std::string& name = all.table.figures[finding.figure];
  const double value = one.figures[finding.figure];
  return std::isnan(value) ? "no " + name : name + format(" %.4g", value);
}

std::vector<std::size_t> failed_cases(const ResultTable& table, std::size_t most) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size() && rows.size() < most; ++row) {
    if (!table.rows[row].has_run()) rows.push_back(row);
  }
  return rows;
}

std::string cases_text(const Findings& all) {
  const std::size_t flown = all.table.rows.size();
  std::string text = format("%zu", flown);
  if (flown < all.campaign.cases) text += format(" of %s%u", all.campaign.look_every > 0 ? "at most " : "", all.campaign.cases);
  text += text == "1" ? " case" : " cases";
  if (all.stopped) text += ", as its rule stopped it";
  if (const std::size_t never = never_valid(all.table); never > 0) text += format("; in %zu of them no pose was ever valid", never);
  if (!all.complete()) text += "; the others are missing, so that all that follows is preliminary";
  if (all.not_run == 0) return text;
  const std::string counts = all.findings.empty() ? "" : all.not_run == 1 ? ", which counts as outside" : ", which count as outside";
  return text + format("; %u failed to run", all.not_run) + counts;
}

}  // namespace lasso::mdat
