#include "mdat/run/results.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/run/integrity.hpp"
#include "mdat/run/paper.hpp"
#include "mdat/run/relative_table.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

Json axes_json(const ErrorStatistics& errors) {
  Json json;
  for (const ErrorAxis& axis : kErrorAxes) json[axis.key] = {{"mean", (errors.*axis.member).mean}, {"std", (errors.*axis.member).std}};
  return json;
}

Json with_rms(const ErrorStatistics& errors) {
  Json json = axes_json(errors);
  json["rms_mm"] = errors.rms_mm;
  json["rms_deg"] = errors.rms_deg;
  return json;
}

Json settled_json(const SettledStatistics& rates) {
  return {{"frames", rates.frames},        {"lost", rates.lost},         {"invalid", rates.invalid},
          {"rms_degps", rates.rms_degps},  {"rms_mmps", rates.rms_mmps}, {"worst_degps", rates.worst_degps},
          {"worst_mmps", rates.worst_mmps}};
}

Json statistics_json(const RunStatistics& run, bool noise, bool bound) {
  Json json = axes_json(run.registration);
  json["frames"] = run.frames;
  json["lost"] = run.lost;
  json["invalid"] = run.invalid;
  json["wrong"] = run.wrong;
  json["rms_mm"] = run.registration.rms_mm;
  json["rms_deg"] = run.registration.rms_deg;
  if (bound) {
    json["crlb_mm"] = run.crlb_mm;
    json["crlb_deg"] = run.crlb_deg;
  } else {
    json["rates"] = {{"rms_degps", run.omega_rms_degps}, {"rms_mmps", run.v_rms_mmps}};
    json["settled"] = settled_json(run.settled);
  }
  json["nees"] = noise ? Json(run.nees) : Json(nullptr);
  json["estimate_us"] = {{"median", run.time.median_us}, {"p99", run.time.p99_us}, {"max", run.time.max_us}};
  json["filtered"] = with_rms(run.filtered);
  json.update(integrity_json(integrity_of(run)));
  return json;
}

Json found_json(const CaseResult& run) { return run.found_frame ? Json(*run.found_frame) : Json(nullptr); }

Json variant_json(const VariantResult& variant, const Scenario& scenario) {
  Json json = statistics_json(variant.all, variant.variant.noise, scenario.variants != 0);
  json["image_crc"] = format("%08X", variant.image_crc);
  if (scenario.variants != 0) {
    const ErrorStatistics& edge_on = variant.edge_on.registration;
    json["edge_on"] = {{"frames", variant.edge_on.frames},
                       {"axial_std_mm", edge_on.axial_mm.std},
                       {"roll_std_deg", edge_on.roll_deg.std},
                       {"rms_mm", edge_on.rms_mm},
                       {"rms_deg", edge_on.rms_deg}};
    json["edge_on"]["nees"] = variant.variant.noise ? Json(variant.edge_on.nees) : Json(nullptr);
  }
  json["by_range"] = Json::array();
  for (std::size_t i = 0; i < variant.by_range.size(); ++i) {
    Json range = {{"range_m", scenario.runs_m()[i]}};
    if (scenario.prior == 0) range["found_frame"] = found_json(variant.cases.at(i));
    range.update(statistics_json(variant.by_range[i], variant.variant.noise, scenario.variants != 0));
    json["by_range"].push_back(range);
  }
  return json;
}

// A column of numbers, right-aligned; a dash of what nothing is known of.
std::string column(double value, int width, int count) { return format("%*s", width, known(value, count, "-").c_str()); }

std::string cell(const MeanStd& value) { return column(value.mean, 8, 4) + " /" + column(value.std, 8, 4); }

// One column an axis table: the paper's first where it applies.
std::string axes_table(const TableResult& table, bool paper) {
  std::string text = "  mean / std   ";
  if (paper) text += format("%-21s", "   paper 2005");
  for (const VariantResult& variant : table.variants) text += format("%-23s", variant.variant.title);
  text += "\n";
  const ErrorStatistics reference = paper_table_1();
  for (const ErrorAxis& axis : kErrorAxes) {
    text += format("  %-6s %-4s ", axis.name, axis.unit);
    if (paper) text += cell(reference.*axis.member) + "   ";
    for (const VariantResult& variant : table.variants) text += cell(variant.all.registration.*axis.member) + "     ";
    text += "\n";
  }
  return text;
}

std::string ratio(double value, double bound) { return bound > 0 ? format("%6.2f", value / bound) : std::string("     -"); }

std::string quality_line(const VariantResult& variant, bool bound) {
  const RunStatistics& run = variant.all;
  std::string text = format("  %-24s ", variant.variant.title);
  const bool tracked = run.lost < run.frames;
  text += tracked ? column(run.registration.rms_mm, 7, 4) + " " + column(run.registration.rms_deg, 8, 5) : std::string("every frame lost");
  if (bound) {
    const bool noise = variant.variant.noise;
    text +=
        "  " + ratio(run.registration.rms_mm, noise ? run.crlb_mm : 0) + " " + ratio(run.registration.rms_deg, noise ? run.crlb_deg : 0);
  } else {
    text += "  " + column(run.omega_rms_degps, 6, 3) + " " + column(run.v_rms_mmps, 6, 1);
  }
  text += variant.variant.noise ? "  " + column(run.nees, 6, 2) : std::string("       -");
  text += format("  %4zu/%-5zu %5zu  %5zu", run.lost, run.frames, run.invalid, run.wrong);
  return text + format("  %7.0f %7.0f %7.0f\n", run.time.median_us, run.time.p99_us, run.time.max_us);
}

std::string quality_table(const TableResult& table) {
  const bool bound = table.scenario.variants != 0;
  std::string text = "                            rms error         ";
  text += bound ? "over bound      " : "rates error     ";
  text += "NEES  lost       invalid wrong  time of an estimate, us\n";
  text += "                            mm       deg      ";
  text += bound ? "mm     deg      " : "deg/s  mm/s     ";
  text += "of 6                              median     p99     max\n";
  for (const VariantResult& variant : table.variants) text += quality_line(variant, bound);
  for (const std::string& warning : warnings_of(table)) text += "  " + warning + "\n";
  return text;
}

Json run_json(const TimelineStatistics& run) {
  return {{"frames", run.frames},
          {"valid", run.valid},
          {"wrong", run.wrong},
          {"rms_mm", run.rms_mm},
          {"rms_deg", run.rms_deg},
          {"worst_mm", run.worst_mm},
          {"worst_deg", run.worst_deg},
          {"nees", run.nees},
          {"filtered",
           {{"rms_mm", run.filtered_rms_mm},
            {"rms_deg", run.filtered_rms_deg},
            {"worst_mm", run.filtered_worst_mm},
            {"worst_deg", run.filtered_worst_deg}}}};
}

Json groups_json(const std::vector<TimelineGroup>& groups) {
  Json json = Json::object();
  for (const TimelineGroup& group : groups) json[group.name] = run_json(group.statistics);
  return json;
}

const RunStatistics& statistics_of(const SimulationResult& result) { return result.tables.front().variants.front().all; }

Json timeline_json(const SimulationResult& result, const Timeline& timeline) {
  Json json = run_json(timeline_statistics(timeline));
  if (result.flown().autonomous != 0) json.update(integrity_json(integrity_of(statistics_of(result))));
  json["by_mode"] = groups_json(by_mode(timeline));
  json["by_sensor"] = groups_json(by_sensor(timeline, result.sensors));
  json["by_part"] = groups_json(by_part(timeline, result.parts));
  json["changes"] = Json::array();
  for (const TimelineChange& change : timeline.changes) {
    json["changes"].push_back(
        {{"t_s", change.t_s}, {"from", to_string(change.from)}, {"event", to_string(change.event)}, {"to", to_string(change.to)}});
  }
  json["sensor_changes"] = Json::array();
  for (const SensorChange& change : sensor_changes(timeline)) {
    json["sensor_changes"].push_back({{"t_s", change.t_s},
                                      {"range_m", change.range_m},
                                      {"from", result.sensors.at(change.from)},
                                      {"to", result.sensors.at(change.to)},
                                      {"reason", to_string(change.reason)}});
  }
  return json;
}

// What TOML writes of numbers, lists and texts is JSON, too; names of files have no quotes.
Json settings_json(const std::vector<EffectiveValue>& values) {
  Json json = Json::object();
  for (const EffectiveValue& value : values) {
    if (!value.key.empty()) json[value.key] = Json::accept(value.value) ? Json::parse(value.value) : Json(value.value);
  }
  return json;
}

std::string groups_text(const char* title, const std::vector<TimelineGroup>& groups) {
  std::string text =
      format("\n  %-18s frames  valid  wrong     rms, mm  worst     rms, deg  worst     NEES   filtered, mm  worst     deg\n", title);
  for (const auto& [name, run] : groups) {
    if (run.valid == 0) {
      text += format("  %-18s %6zu %6zu\n", name.c_str(), run.frames, run.valid);
      continue;
    }
    text += format("  %-18s %6zu %6zu %6zu  %9.2f %8.1f  %8.4f %8.3f  %5.1f  %9.2f %8.1f  %8.4f\n", name.c_str(), run.frames, run.valid,
                   run.wrong, run.rms_mm, run.worst_mm, run.rms_deg, run.worst_deg, run.nees, run.filtered_rms_mm, run.filtered_worst_mm,
                   run.filtered_rms_deg);
  }
  return text;
}

// Changes of mode and sensor, a line each, in the order of their times.
std::string changes_text(const SimulationResult& result, const Timeline& timeline) {
  std::multimap<double, std::string> lines;
  for (const TimelineChange& change : timeline.changes)
    lines.emplace(change.t_s, format("%-12s from %s: %s\n", to_string(change.to), to_string(change.from), meaning(change)));
  for (const SensorChange& change : sensor_changes(timeline)) {
    lines.emplace(change.t_s, format("sensor %s after %s, at %.1f m: %s\n", result.sensors.at(change.to).c_str(),
                                     result.sensors.at(change.from).c_str(), change.range_m, to_string(change.reason)));
  }
  std::string text;
  for (const auto& [t_s, line] : lines) text += format("  %7.1f  ", t_s) + line;
  return text;
}

std::string timeline_text(const SimulationResult& result, const Timeline& timeline) {
  const TimelineStatistics run = timeline_statistics(timeline);
  std::string text =
      format("%s, scenario %s: %zu frames\n\n  time, s  mode, or sensor\n", result.mission.c_str(), result.scenario.c_str(), run.frames);
  text += changes_text(result, timeline);
  text += groups_text("by mode", by_mode(timeline)) + groups_text("by sensor", by_sensor(timeline, result.sensors)) +
          groups_text("by part", by_part(timeline, result.parts));
  if (run.valid == 0) return text + format("\n  no valid pose in %zu frames\n\n", run.frames);
  text += "\n" + aligned_text(integrity_list(integrity_of(statistics_of(result))));
  text += format("\n  valid poses %zu, of these wrong %zu; rms %.2f mm, %.4f deg; worst %.1f mm, %.3f deg; NEES %.2f of 6\n\n", run.valid,
                 run.wrong, run.rms_mm, run.rms_deg, run.worst_mm, run.worst_deg, run.nees);
  return text;
}

const Timeline& timeline_of(const SimulationResult& result) { return result.tables.front().variants.front().cases.front().timeline; }

bool ends_on_target(const CaseResult& run) { return !run.frames.empty() && run.frames.back().valid && !run.frames.back().lost(); }

std::string rates_text(const SettledStatistics& settled) {
  return format("error of the rates rms %.3f deg/s, %.2f mm/s, worst %.3f, %.2f\n", settled.rms_degps, settled.rms_mmps,
                settled.worst_degps, settled.worst_mmps);
}

// How many runs end on the target, and how well the filter knew it: the table is of single scans.
std::string tracked_text(const TableResult& table) {
  std::string text;
  for (const VariantResult& variant : table.variants) {
    const auto tracked = std::count_if(variant.cases.begin(), variant.cases.end(), ends_on_target);
    text += format("  %s: tracked in the last frame %zu of %zu runs; the filter's pose rms %s mm, %s deg\n", variant.variant.title,
                   static_cast<std::size_t>(tracked), variant.cases.size(), known(variant.all.filtered.rms_mm, 4, "-").c_str(),
                   known(variant.all.filtered.rms_deg, 5, "-").c_str());
  }
  return text;
}

// "unchecked 26, weak 3": why frames of a variant are without a valid pose, the most frequent reason first; empty where all have one.
// A frame of which no packet says anything, as the track was given up, is "no packet".
std::string reasons_text(const VariantResult& variant) {
  std::map<std::string, std::size_t> counts;
  for (const CaseResult& run : variant.cases) {
    for (const FrameError& frame : run.frames) {
      if (!frame.valid) ++counts[frame.told ? to_string(frame.reason) : "no packet"];
    }
  }
  std::vector<std::pair<std::string, std::size_t>> rows(counts.begin(), counts.end());
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [reason, count] : rows) text += (text.empty() ? "" : ", ") + format("%s %zu", reason.c_str(), count);
  return text;
}

std::string invalid_text(const TableResult& table) {
  std::string text;
  for (const VariantResult& variant : table.variants) {
    const std::string reasons = reasons_text(variant);
    if (!reasons.empty())
      text += format("  %s: frames without a valid pose: %s (docs/glossary.md)\n", variant.variant.title, reasons.c_str());
  }
  return text;
}

std::string settled_text(const TableResult& table) {
  std::string text;
  for (const VariantResult& variant : table.variants) {
    const SettledStatistics& settled = variant.all.settled;
    text += format("  after %zu frames of each run, %s: ", kSettlingFrames, variant.variant.title);
    if (settled.frames == 0) {
      text += "no run is so long\n";
      continue;
    }
    text += format("lost %zu/%zu, invalid %zu; ", settled.lost, settled.frames, settled.invalid);
    text += std::isnan(settled.rms_degps) ? std::string("no frame is reported\n") : rates_text(settled);
  }
  return text;
}

std::string integrity_text(const TableResult& table) {
  std::vector<std::vector<std::string>> lines = {integrity_head("integrity")};
  for (const VariantResult& variant : table.variants) lines.push_back(integrity_row(variant.variant.title, integrity_of(variant.all), "-"));
  return aligned_text(lines);
}

// When each run had its first valid pose.
std::string found_text(const TableResult& table) {
  std::string text;
  for (const VariantResult& variant : table.variants) {
    for (std::size_t i = 0; i < variant.cases.size(); ++i) {
      const std::optional<std::uint32_t>& frame = variant.cases[i].found_frame;
      text += format("  at %g m without a prior: ", table.scenario.ranges_m[i]);
      text += frame ? format("found after %.1f s, tracked from frame %u\n", *frame * variant.parameters.period_s, *frame) : "not found\n";
    }
  }
  return text;
}

std::string table_text(const SimulationResult& result, const TableResult& table) {
  const Scenario& scenario = table.scenario;
  std::string text = format("%s, scenario %s%s: ", result.mission.c_str(), result.scenario.c_str(), table.name.empty() ? "" : ", no tilt");
  text += format("%s x %u frames, %s, registration of single scans\n", runs_text(scenario).c_str(), result.frames,
                 attitude_text(scenario).c_str());
  text += axes_table(table, is_beside_paper(table));
  text += quality_table(table);
  text += integrity_text(table);
  text += invalid_text(table);
  if (scenario.variants == 0) text += tracked_text(table) + settled_text(table);
  if (scenario.prior == 0) text += found_text(table);
  return text + "\n";
}

}  // namespace

std::string attitude_text(const Scenario& scenario) {
  if (scenario.scene != nullptr) return "a scene";
  return scenario.drawn != 0 ? "attitudes drawn" : format("tilt %g deg", scenario.tilt_rad / kRadPerDeg);
}

std::string runs_text(const Scenario& scenario) {
  if (scenario.scene != nullptr) return format("1 run from %.4g m on", scenario.ranges_m.front());
  const std::vector<double> runs_m = scenario.runs_m();
  const auto [nearest, farthest] = std::minmax_element(runs_m.begin(), runs_m.end());
  const std::string runs = format("%zu %s%s", runs_m.size(), scenario.drawn != 0 ? "flight" : "range", runs_m.size() == 1 ? "" : "s");
  if (*nearest == *farthest) return runs + format(" at %g m", *nearest);
  return runs + format(" from %g to %g m", *nearest, *farthest);
}

std::string run_text(const Scenario& scenario, std::size_t run) {
  const std::string range = format("%g m", scenario.runs_m()[run]);
  return scenario.drawn != 0 ? format("flight %zu, ", run + 1) + range : range;
}

bool is_beside_paper(const TableResult& table) { return table.scenario.paper_table != 0 && table.name.empty(); }

std::vector<std::string> warnings_of(const TableResult& table) {
  std::vector<std::string> warnings;
  for (const VariantResult& variant : table.variants) {
    if (variant.all.wrong == 0) continue;
    warnings.push_back(
        format("%s: %zu of %zu frames say valid and are wrong (off by more than 5 of their own sigma, and by more than 20 mm or 1 deg): in "
               "some views of this target a valid pose may be wrong (docs/limits.md)",
               variant.variant.title, variant.all.wrong, variant.all.frames));
  }
  return warnings;
}

std::string results_json(const SimulationResult& result) {
  Json json = {{"mission", result.mission}, {"scenario", result.scenario}, {"seed", result.seed},     {"frames", result.frames},
               {"sensor", result.sensor},   {"version", kVersion},         {"commit", result.commit}, {"set", result.settings}};
  json["settings"] = settings_json(result.values);
  for (const TableResult& table : result.tables) {
    if (table.scenario.autonomous != 0) continue;  // of which the timeline says all
    Json variants;
    for (const VariantResult& variant : table.variants) variants[variant.variant.name] = variant_json(variant, table.scenario);
    if (table.name.empty()) {
      json.update(variants);
    } else {
      json[table.name] = variants;
    }
  }
  if (!result.relative.empty()) json["relative"] = relative_json(result.relative);
  if (result.flown().has_timeline()) json["timeline"] = timeline_json(result, timeline_of(result));
  if (is_beside_paper(result.tables.front())) json["paper_2005"] = axes_json(paper_table_1());
  return json.dump(2) + "\n";
}

std::string summary_text(const SimulationResult& result) {
  std::string text = "\n";
  if (result.flown().autonomous != 0) text += timeline_text(result, timeline_of(result));
  for (std::size_t i = 0; result.flown().autonomous == 0 && i < result.tables.size(); ++i) text += table_text(result, result.tables[i]);
  return result.relative.empty() ? text : text + relative_text(result.relative) + "\n";
}

}  // namespace lasso::mdat
