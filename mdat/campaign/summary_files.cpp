#include "mdat/campaign/summary_files.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/campaign/figures.hpp"
#include "mdat/campaign/junit_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// What is not finite is null: JSON has no number for it.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json criterion_json(const Conclusion& one) {
  Json json;
  json["name"] = one.criterion.name;
  json["figure"] = one.criterion.figure;
  json["at_least"] = number(one.criterion.at_least);
  json["at_most"] = number(one.criterion.at_most);
  json["share_min"] = one.criterion.share_min;
  json["confidence"] = one.criterion.confidence;
  json["verdict"] = to_string(one.verdict);
  json["cases"] = one.cases;
  json["within"] = one.within;
  json["failed_to_run"] = one.not_run;
  json["without_figure"] = one.unknown;
  json["share"] = one.share();
  json["share_limits"] = {one.limits.lower, one.limits.upper};
  json["limits_by"] = one.sequence ? "confidence sequence" : "Clopper-Pearson";
  json["more_cases_to_decide"] = one.more ? Json(*one.more) : Json();
  return json;
}

Json finding_json(const Findings& all, const Finding& finding) {
  Json json = criterion_json(finding.conclusion);
  json["worst_cases"] = Json::array();
  for (const std::size_t row : finding.worst) json["worst_cases"].push_back(all.table.rows[row].number);
  json["rank_correlations"] = Json::array();
  for (const Correlation& one : finding.correlations)
    json["rank_correlations"].push_back({{"column", all.table.columns[one.column]}, {"rho", one.rho}, {"p_holm", one.probability}});
  return json;
}

std::string test_case(const Findings& all, const std::string& name, const std::string& content) {
  return junit_case("campaign." + all.campaign.name, name, content);
}

std::string commands(const Findings& all, const std::vector<std::size_t>& rows, const Finding* finding) {
  std::string text;
  for (const std::size_t row : rows)
    text += (finding == nullptr ? reason_text(all.table.rows[row]) : case_text(all, *finding, row)) + ": " +
            case_command(all, all.table.rows[row].number) + "\n";
  return text;
}

std::string criterion_case(const Findings& all, const Finding& finding) {
  const Conclusion& one = finding.conclusion;
  if (one.verdict == Verdict::kMet) return test_case(all, one.criterion.name, "");
  const std::string message = criterion_text(one.criterion) + format(": %s, %u of %u cases", to_string(one.verdict), one.within, one.cases);
  const std::string text =
      conclusion_text(one) + "\nThe worst cases, and how to fly them again:\n" + commands(all, finding.worst, &finding);
  return test_case(all, one.criterion.name, junit_trouble("failure", to_string(one.verdict), message, text));
}

constexpr std::size_t kNamedCases = 10;

std::string all_run_case(const Findings& all) {
  const std::vector<std::size_t> rows = failed_cases(all.table, kNamedCases);
  const std::string text = commands(all, rows, nullptr);
  if (!all.complete()) {
    const std::string missing = format("%zu of %u cases are missing", all.campaign.cases - all.table.rows.size(), all.campaign.cases);
    return test_case(all, "all cases run", junit_trouble("error", "missing", missing, text));
  }
  if (rows.empty()) return test_case(all, "all cases run", "");
  const std::string message = format("%u of %zu cases failed to run", all.not_run, all.table.rows.size());
  return test_case(all, "all cases run", junit_trouble("error", "failed to run", message, text));
}

}  // namespace

std::string results_csv(const ResultTable& table) {
  std::string text = "case,status";
  for (const auto* names : {&table.figures, &table.columns}) {
    for (const std::string& name : *names) text += "," + csv_cell(name);
  }
  text += "\n";
  for (const CaseRow& row : table.rows) {
    text += format("%u,", row.number) + csv_cell(row.status);
    for (const auto* values : {&row.figures, &row.drawn}) {
      for (const double value : *values) text += "," + cell_text(value);
    }
    text += "\n";
  }
  return text;
}

std::string summary_json(const Findings& all) {
  Json json;
  json["campaign"] = all.campaign.name;
  json["scenario"] = all.campaign.scenario;
  json["seed"] = all.campaign.seed;
  json["cases"] = all.table.rows.size();
  json["cases_at_most"] = all.campaign.cases;
  json["stopped_by_rule"] = all.stopped;
  json["complete"] = all.complete();
  json["failed_to_run"] = all.not_run;
  if (all.integrity) {
    json.update(integrity_json(*all.integrity));
  } else {
    json["time_to_alert"] = json["protection"] = nullptr;  // not kept
  }
  json["criteria"] = Json::array();
  for (const Finding& finding : all.findings) json["criteria"].push_back(finding_json(all, finding));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string junit_xml(const Findings& all) {
  const auto failures = std::count_if(all.findings.begin(), all.findings.end(),
                                      [](const Finding& finding) { return finding.conclusion.verdict != Verdict::kMet; });
  const std::string counts = format("tests=\"%zu\" failures=\"%td\" errors=\"%d\" time=\"0\"", all.findings.size() + 1, failures,
                                    all.not_run > 0 || !all.complete() ? 1 : 0);
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts + ">\n  <testsuite name=\"campaign." +
                     xml_text(all.campaign.name) + "\" " + counts + " skipped=\"0\">\n";
  for (const Finding& finding : all.findings) text += criterion_case(all, finding);
  return text + all_run_case(all) + "  </testsuite>\n</testsuites>\n";
}

}  // namespace lasso::mdat
