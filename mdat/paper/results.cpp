#include "mdat/run/results.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/paper/results.hpp"
#include "mdat/run/paper.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

std::string pair_text(double mean, double std) { return small_number(mean) + " ± " + small_number(std); }
std::string pair_text(const MeanStd& value) { return pair_text(value.mean, value.std); }

const VariantResult& variant_at(const PaperResult& result, std::size_t i) { return result.simulation.tables.front().variants.at(i); }

// As the paper has it.
std::string paper_pair(double mean, double std) { return format("%g ± %g", mean, std); }

std::string absolute_text(const FigureErrors& errors, double scale) { return pair_text(scale * errors.mean_abs, scale * errors.std_abs); }

PaperRow laboratory_row(const PaperResult& result, LaboratoryFigure figure, const std::string& paper) {
  const ShownFigure& shown = kShownFigures[static_cast<std::size_t>(figure)];
  return {std::string("table 2, ") + shown.title, shown.unit, paper, "",
          absolute_text(figure_errors(result.laboratory, figure), shown.scale)};
}

PaperRow time_row(const PaperResult& result, const char* machine, double paper_ms) {
  const double ms = 1e-3 * result.laboratory.time.median_us;
  return {format("an estimate: %s, here on %s", machine, result.machine.c_str()), "ms", known(paper_ms, 1, "–"),
          known(1e-3 * variant_at(result, 0).all.time.median_us, 2, "–"), known(ms, 2, "–")};
}

std::vector<std::vector<std::string>> budget_lines(const LaboratoryResult& laboratory) {
  std::vector<std::vector<std::string>> lines = {{"  laboratory, rms", "here", "budget", "ratio", "", "stands"}};
  for (std::size_t i = 0; i < kLaboratoryFigures; ++i) {
    const FigureErrors errors = figure_errors(laboratory, static_cast<LaboratoryFigure>(i));
    const ShownFigure& shown = kShownFigures[i];
    lines.push_back({format("  %s, %s", shown.title, shown.unit), known(shown.scale * errors.rms, shown.digits, "-"),
                     known(shown.scale * errors.budget, shown.digits, "-"), known(errors.ratio(), 2, "-"),
                     errors.held() ? "held" : format("above %g", kBudgetRatioMax), format("%zu", errors.count)});
  }
  return lines;
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json errors_json(const FigureErrors& errors, double scale) {
  Json json = {{"stands", errors.count},
               {"mean_abs", finite(scale * errors.mean_abs)},
               {"std_abs", finite(scale * errors.std_abs)},
               {"rms", finite(scale * errors.rms)},
               {"budget", finite(scale * errors.budget)},
               {"ratio", finite(errors.ratio())},
               {"held", errors.held()}};
  for (std::size_t s = 0; s < kBudgetSources; ++s)
    json["budget_by_source"][kBudgetSourceNames[s]] = finite(scale * errors.budget_by_source[s]);
  return json;
}

Json axes_of(const ErrorStatistics& errors) {
  Json json;
  for (const ErrorAxis& axis : kErrorAxes) json[axis.key] = {{"mean", (errors.*axis.member).mean}, {"std", (errors.*axis.member).std}};
  return json;
}

Json simulation_json(const PaperResult& result) {
  Json json = {{"paper", axes_of(paper_table_1())}, {"seed", result.simulation.seed}};
  for (const VariantResult& variant : result.simulation.tables.front().variants) {
    Json here = axes_of(variant.all.registration);
    here["frames"] = variant.all.frames;
    here["lost"] = variant.all.lost;
    here["invalid"] = variant.all.invalid;
    here["rms_mm"] = finite(variant.all.registration.rms_mm);
    here["rms_deg"] = finite(variant.all.registration.rms_deg);
    json[variant.variant.name] = here;
  }
  return json;
}

Json counts_json(const LaboratoryRange& range) {
  std::size_t frames = 0, lost = 0, invalid = 0;
  for (const StandResult& stand : range.stands) {
    frames += stand.frames;
    lost += stand.lost;
    invalid += stand.invalid;
  }
  return {{"scenario", range.scenario}, {"range_m", range.range_m}, {"frames", frames}, {"lost", lost}, {"invalid", invalid}};
}

Json seeds_json(const LaboratoryResult& laboratory) {
  Json json = Json::array();
  for (const Scenario& scenario : laboratory.scenarios) json.push_back(static_cast<std::uint64_t>(scenario.seed));
  return json;
}

Json laboratory_json(const LaboratoryResult& laboratory) {
  Json json = {{"simulated", true},
               {"frames", laboratory.frames},
               {"stands", laboratory.stands},
               {"mock_ups", laboratory.mock_ups},
               {"seeds", seeds_json(laboratory)},
               {"ratio_at_most", kBudgetRatioMax},
               {"paper",
                {{"z_mm", {{"mean", kPaperTable2.z_mean_mm}, {"std", kPaperTable2.z_std_mm}}},
                 {"turn_deg", {{"mean", kPaperTable2.turn_mean_deg}, {"std", kPaperTable2.turn_std_deg}}}}}};
  for (std::size_t i = 0; i < kLaboratoryFigures; ++i)
    json[kShownFigures[i].key] = errors_json(figure_errors(laboratory, static_cast<LaboratoryFigure>(i)), kShownFigures[i].scale);
  json["by_range"] = Json::array();
  for (std::size_t r = 0; r < laboratory.ranges.size(); ++r) {
    Json range = counts_json(laboratory.ranges[r]);
    for (std::size_t i = 0; i < kLaboratoryFigures; ++i)
      range[kShownFigures[i].key] = errors_json(figure_errors(laboratory, static_cast<LaboratoryFigure>(i), r), kShownFigures[i].scale);
    json["by_range"].push_back(range);
  }
  return json;
}

Json time_json(const PaperResult& result) {
  const auto of = [](const TimeStatistics& time) { return Json{{"median", time.median_us}, {"p99", time.p99_us}, {"max", time.max_us}}; };
  return {{"machine", result.machine},
          {"paper_laptop_ms", kPaperTime.laptop_ms},
          {"paper_card_ms", kPaperTime.card_ms},
          {"simulation_us", of(variant_at(result, 0).all.time)},
          {"laboratory_us", of(result.laboratory.time)}};
}

}  // namespace

std::string small_number(double value) {
  constexpr double kShownByDecimals = 0.001;
  if (!std::isfinite(value)) return "–";
  return value == 0 || std::fabs(value) >= kShownByDecimals ? decimals(value, 4) : format("%.1e", value);
}

std::vector<PaperRow> paper_rows(const PaperResult& result) {
  std::vector<PaperRow> rows;
  const ErrorStatistics paper = paper_table_1();
  for (const ErrorAxis& axis : kErrorAxes) {
    rows.push_back({std::string("table 1, ") + axis.name, axis.unit, paper_pair((paper.*axis.member).mean, (paper.*axis.member).std),
                    pair_text(variant_at(result, 0).all.registration.*axis.member),
                    pair_text(variant_at(result, 1).all.registration.*axis.member)});
  }
  rows.push_back(laboratory_row(result, LaboratoryFigure::kZ, paper_pair(kPaperTable2.z_mean_mm, kPaperTable2.z_std_mm)));
  rows.push_back(laboratory_row(result, LaboratoryFigure::kTurnStep, paper_pair(kPaperTable2.turn_mean_deg, kPaperTable2.turn_std_deg)));
  rows.push_back(time_row(result, "paper on a 1.6 GHz Pentium M", kPaperTime.laptop_ms));
  rows.push_back(time_row(result, "paper on a PowerPC 603e", kPaperTime.card_ms));
  return rows;
}

std::string paper_text(const PaperResult& result) {
  std::vector<std::vector<std::string>> lines = {{"  mean ± std", "unit", "paper, 2005", "here, no noise", "here, with noise"}};
  for (const PaperRow& row : paper_rows(result))
    lines.push_back({"  " + row.what, row.unit, row.paper, row.here.empty() ? "-" : row.here, row.noisy});
  std::string text = "\nThe experiments of the 3DLASSO paper (2005); the laboratory test is simulated\n" + aligned_text(lines) + "\n";
  text += aligned_text(budget_lines(result.laboratory));
  text += format("\n  times: processor time on one core of %s\n", result.machine.c_str());
  std::string unknown;
  for (const PaperItem& item : paper_items()) {
    if (item.shows.rfind("not known here", 0) == 0) unknown += (unknown.empty() ? "" : ", ") + item.name;
  }
  return text + "  what these show is not known here: " + unknown + "\n\n";
}

std::string paper_json(const PaperResult& result) {
  Json json = {{"version", kVersion}, {"commit", result.commit}, {"seconds", result.seconds}};
  json["table_1"] = simulation_json(result);
  json["table_2"] = laboratory_json(result.laboratory);
  json["time"] = time_json(result);
  for (const PaperItem& item : paper_items()) json["items"].push_back({{"name", item.name}, {"shows", item.shows}, {"here", item.here}});
  return json.dump(2) + "\n";
}

}  // namespace lasso::mdat
