#include "mdat/report/report.hpp"

#include <algorithm>
#include <limits>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/report/about_view.hpp"
#include "mdat/report/doubtful_view.hpp"
#include "mdat/report/figures.hpp"
#include "mdat/report/flights_view.hpp"
#include "mdat/report/page.hpp"
#include "mdat/report/scan_view.hpp"
#include "mdat/report/scene_view.hpp"
#include "mdat/report/stanford_view.hpp"
#include "mdat/report/timeline_view.hpp"
#include "mdat/run/paper.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string mean_std_cell(const MeanStd& value) { return known(value.mean, 4, "–") + " <small>±</small> " + known(value.std, 4, "–"); }

// The paper's table 1 beside this run's: axes down, runs across.
std::string accuracy_table(const TableResult& table, bool paper) {
  HtmlTable html;
  html.head = {"mean ± std"};
  if (paper) html.head.push_back("paper, 2005");
  for (const VariantResult& variant : table.variants) html.head.push_back(variant.variant.title);
  const ErrorStatistics reference = paper_table_1();
  for (const ErrorAxis& axis : kErrorAxes) {
    std::vector<std::string> row = {format("%s, %s", axis.name, axis.unit)};
    if (paper) row.push_back(mean_std_cell(reference.*axis.member));
    for (const VariantResult& variant : table.variants) row.push_back(mean_std_cell(variant.all.registration.*axis.member));
    html.rows.push_back(row);
  }
  return to_html(html);
}

std::vector<std::string> quality_row(const std::string& name, const RunStatistics& run, bool noise, bool bound) {
  std::vector<std::string> row = {name};
  for (const std::size_t count : {run.frames, run.lost, run.invalid, run.wrong}) row.push_back(format("%zu", count));
  const auto add = [&row](double value, int count) { row.push_back(known(value, count, "–")); };
  add(run.registration.rms_mm, 4);
  add(run.registration.rms_deg, 5);
  add(bound && noise ? run.registration.rms_mm / run.crlb_mm : kNone, 3);
  add(bound && noise ? run.registration.rms_deg / run.crlb_deg : kNone, 3);
  add(noise ? run.nees : kNone, 2);
  add(run.filtered.rms_mm, 4);
  add(run.filtered.rms_deg, 5);
  for (const double time_us : {run.time.median_us, run.time.p99_us, run.time.max_us}) row.push_back(format("%.0f", time_us));
  return row;
}

HtmlTable quality_head(const std::string& first) {
  HtmlTable html;
  html.head = {
      first,  "frames",       "lost",          "invalid",    "wrong",   "rms, mm", "rms, deg", "over bound (mm)", "over bound (deg)",
      "NEES", "filtered, mm", "filtered, deg", "median, us", "p99, us", "max, us"};
  return html;
}

std::string quality_table(const TableResult& table) {
  const bool bound = table.scenario.variants != 0;
  HtmlTable html = quality_head("variant");
  for (const VariantResult& variant : table.variants)
    html.rows.push_back(quality_row(variant.variant.title, variant.all, variant.variant.noise, bound));
  return to_html(html);
}

std::string range_table(const TableResult& table) {
  const bool bound = table.scenario.variants != 0;
  const char* run = table.scenario.drawn != 0 ? "flight" : "range";
  HtmlTable html = quality_head(format("variant, %s", run));
  for (const VariantResult& variant : table.variants) {
    for (std::size_t i = 0; i < variant.by_range.size(); ++i) {
      const std::string name = std::string(variant.variant.title) + ", " + run_text(table.scenario, i);
      html.rows.push_back(quality_row(name, variant.by_range[i], variant.variant.noise, bound));
    }
  }
  return format("<details><summary>The same by %s</summary>", run) + to_html(html) + "</details>\n";
}

// The variant that a person looks at first: with noise and silhouettes where there is one.
const VariantResult& main_variant(const TableResult& table) {
  for (const VariantResult& variant : table.variants) {
    if (variant.variant.noise && variant.variant.silhouettes) return variant;
  }
  return table.variants.front();
}

const std::vector<KeptScan>& shown_scans(const TableResult& table) { return main_variant(table).cases[shown_range(table.scenario)].scans; }

std::vector<ScanPanel> shown_panels(const TableResult& table) {
  std::vector<ScanPanel> panels;
  for (const KeptScan& scan : shown_scans(table)) {
    const std::string when = turns_by_steps(table)       ? format("%.0f°", scan.frame * table.scenario.step_rad / kRadPerDeg)
                             : table.scenario.drawn != 0 ? format("flight %zu", shown_range(table.scenario) + 1)
                                                         : format("frame %u", scan.frame);
    panels.push_back({&scan, when + format(": %u of %u rays return", scan.telemetry.returns, scan.telemetry.plan_points),
                      Vec3(table.scenario.center_m.data())});
  }
  return panels;
}

std::string scans_figure(Plotter& plotter, const sim::RayCaster& target, const TableResult& table) {
  if (shown_scans(table).empty() || table.scenario.has_profile()) return "";
  const std::string caption =
      format("The scan on the target at %g m, as the sensor sees it. The model is drawn at the estimated pose. %s%s",
             table.scenario.runs_m()[shown_range(table.scenario)], kScanLegend,
             main_variant(table).parameters.aimed_share > 0 ? " Violet: rays aimed at contours." : "");
  return figure(scan_view(plotter, target, shown_panels(table), true), caption);
}

std::string angle_text(const TableResult& table, const VariantResult& variant) {
  if (table.scenario.drawn != 0) return format("frame, %s: a line a flight", variant.variant.title);
  if (!turns_by_steps(table)) return format("frame, %s", variant.variant.title);
  return format("target's angle, %s%s", variant.variant.title, table.scenario.paper_table != 0 ? " (the paper's figure 11)" : "");
}

std::string angle_figures(Plotter& plotter, const TableResult& table) {
  std::string html;
  for (const VariantResult& variant : table.variants) {
    if (!variant.variant.silhouettes && table.variants.size() > 1) continue;
    html += figure(
        error_against_angle(plotter, table, variant),
        format("Error of the registration of each single scan against the %s. X, Y, Z in sensor axes; yaw, pitch, roll about the target's "
               "z, y, x.",
               angle_text(table, variant).c_str()));
  }
  return html;
}

std::string range_figure(Plotter& plotter, const TableResult& table) {
  return figure(error_against_range(plotter, table),
                format("Root mean square error against range%s%s.", table.scenario.paper_table != 0 ? " (the paper's figure 13)" : "",
                       has_bound(table) ? ", and the Cramér-Rao bound of the hits of the same scans" : ""));
}

// How well the rates are known, which is what flights are flown for.
std::string rates_part(Plotter& plotter, const TableResult& table) {
  return settled_section(table) +
         figure(
             rates_figure(plotter, main_variant(table)),
             format(
                 "Error of the filter's rates against the frame, %s: a line a flight, gaps where nothing is reported; thick, the root mean "
                 "square of all flights. The start knows no rate.",
                 main_variant(table).variant.title));
}

std::string flights_part(Plotter& plotter, const TableResult& table) {
  return figure(
      flights_figure(plotter, main_variant(table)),
      format("Root mean square errors of each flight, %s: of the registrations of single scans, and of the filter's rates after %zu "
             "frames.",
             main_variant(table).variant.title, kSettlingFrames));
}

std::string section_title(const TableResult& table) {
  const Scenario& scenario = table.scenario;
  if (scenario.drawn != 0) return runs_text(scenario) + ", attitude and axes of each drawn at random";
  if (scenario.scene != nullptr) return "A scene";
  return format("Tilt %g°", scenario.tilt_rad / kRadPerDeg) + (table.name.empty() ? "" : ": truly side-on, the hardest case");
}

std::string table_section(Plotter& plotter, const sim::RayCaster& target, const TableResult& table) {
  const bool flights = table.scenario.drawn != 0;
  std::string html = "<section>\n<h2>" + section_title(table) + "</h2>\n";
  if (flights) html += rates_part(plotter, table) + "</section>\n<section>\n<h2>Poses</h2>\n";
  html += accuracy_table(table, is_beside_paper(table)) + quality_table(table);
  for (const std::string& warning : warnings_of(table)) html += "<p class='note'><b>" + escape(warning) + ".</b></p>\n";
  html += range_table(table);
  html += scans_figure(plotter, target, table) + angle_figures(plotter, table);
  if (table.scenario.runs_m().size() > 1) html += flights ? flights_part(plotter, table) : range_figure(plotter, table);
  html +=
      figure(time_histogram(plotter, table), "Processor time of whole estimates (range image in, pose and covariance out) on one thread.");
  html += doubtful_section(plotter, target, table) + "<h3>Integrity</h3>\n";
  return html + integrity_section(plotter, table, main_variant(table)) + "</section>\n";
}

constexpr double kPictureScale = 0.72;  // of the picture for the README

std::string approach_html(Plotter& plotter, const CompiledMission& mission, const SimulationResult& result,
                          const std::vector<SeenPicture>& pictures) {
  const std::unique_ptr<sim::RayCaster> target = make_target(mission.mesh);
  const Scenario& scenario = result.tables.front().scenario;
  const auto [nearest, farthest] = std::minmax_element(scenario.ranges_m.begin(), scenario.ranges_m.end());
  std::string body = "<h1>" + escape(result.mission) + "</h1>\n";
  body += format(
      "<p class='lead'>Scenario <b>%s</b>, seed %llu: an approach between %g m and %g m of its origin, %u frames, closed loop through the "
      "flight "
      "component, "
      "which begins by looking for the bearing. mdat %s, %.1f s.</p>\n",
      escape(result.scenario).c_str(), static_cast<unsigned long long>(result.seed), *farthest, *nearest, result.frames, kVersion,
      result.seconds);
  body +=
      "<p class='note'>Errors are those of the registration of each single scan against the truth at its reference time, as decoded from "
      "telemetry. Wrong: valid, and off by more than 5 of its own σ and by more than 20 mm or 1°, the registration's or the filter's. "
      "NEES: 6 "
      "when the covariance is honest. –: not known, as there is no valid pose.</p>\n" +
      about_section(mission, result);
  body += relative_section(result) + seen_section(pictures) + timeline_section(plotter, *target, result);
  const TableResult& table = result.tables.front();
  const std::string doubtful = doubtful_section(plotter, *target, table);
  body += "<section>\n<h2>Integrity</h2>\n" + integrity_section(plotter, table, table.variants.front()) + "</section>\n";
  return page(result.mission + ", " + result.scenario, body + (doubtful.empty() ? "" : "<section>\n" + doubtful + "</section>\n"));
}

std::string introduction(const SimulationResult& result) {
  const Scenario& scenario = result.tables.front().scenario;
  std::string text = format(
      "<p class='lead'>Scenario <b>%s</b>, seed %llu: %s, %u frames each, closed loop through the flight component. mdat %s, %.1f s.</p>\n",
      escape(result.scenario).c_str(), static_cast<unsigned long long>(result.seed), runs_text(scenario).c_str(), result.frames, kVersion,
      result.seconds);
  return text +
         "<p class='note'>Errors are those of the registration of each single scan against the truth at its reference time, as decoded "
         "from telemetry; the "
         "filtered pose stands beside them. Lost: more than 50 mm or 5° off. Invalid: without a valid pose. Wrong: valid, and off by more "
         "than "
         "5 of its own σ and by more than 20 mm or 1°. Bound: Cramér-Rao bound of the hits of the same scans "
         "(incidence up to "
         "85°, root of the mean trace). NEES, of valid poses: 6 when the covariance is honest, less where it is larger than the "
         "errors. –: not known: no frame is left to judge, or there is no bound, or no noise that NEES could judge.</p>\n";
}

}  // namespace

std::string report_html(Plotter& plotter, const CompiledMission& mission, const SimulationResult& result,
                        const std::vector<SeenPicture>& pictures) {
  if (result.flown().autonomous != 0) return approach_html(plotter, mission, result, pictures);
  const std::unique_ptr<sim::RayCaster> target = make_target(mission.mesh);
  std::string body = "<h1>" + escape(result.mission) + "</h1>\n" + introduction(result) + about_section(mission, result);
  body += relative_section(result) + seen_section(pictures);
  if (result.flown().has_timeline()) body += timeline_section(plotter, *target, result);
  for (const TableResult& table : result.tables) body += table_section(plotter, *target, table);
  return page(result.mission + ", " + result.scenario, body);
}

std::string picture_png(Plotter& plotter, const CompiledMission& mission, const SimulationResult& result) {
  const TableResult& table = result.tables.front();
  if (shown_scans(table).empty() || table.scenario.has_profile())
    throw PictureError("no scan to show: the run has no frame at the angles of the picture");
  return scan_view_png(plotter, *make_target(mission.mesh), shown_panels(table), true, kPictureScale);
}

}  // namespace lasso::mdat
