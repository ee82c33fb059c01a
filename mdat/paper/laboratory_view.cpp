#include "mdat/paper/laboratory_view.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mdat/common/text.hpp"
#include "mdat/paper/results.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/report/figures.hpp"
#include "mdat/report/page.hpp"

namespace lasso::mdat {
namespace {

// Those that stand beside the paper's table 2.
constexpr ShownFigure kDrawn[] = {kShownFigures[0], kShownFigures[3]};

std::string number(double value, const ShownFigure& shown) { return known(shown.scale * value, shown.digits, "–"); }

// Every value once, in the order of the scenarios: "0.5 mm (2 to 5 m), 3 mm (6 to 7 m)".
std::string by_scenario(const LaboratoryResult& laboratory, double Scenario::*member, double scale, const char* unit) {
  std::set<double> values;
  for (const Scenario& scenario : laboratory.scenarios) values.insert(scenario.*member);
  std::string text;
  for (const Scenario& scenario : laboratory.scenarios) {
    text += (text.empty() ? "" : "; ") + format("%g%s", scale * (scenario.*member), unit);
    if (values.size() == 1) return text;
    text += format(" at %g to %g m", scenario.ranges_m.front(), scenario.ranges_m.back());
  }
  return text;
}

std::string assumptions_table(const LaboratoryResult& lab) {
  HtmlTable html;
  html.words = true;
  html.head = {"source of errors", "as simulated (1 σ)", "how it lasts", "in the budget"};
  const double degrees = 1 / kRadPerDeg;
  const double noise_m = lab.scenarios.front().sigma_k_per_m * 9;
  html.rows = {
      {"Range noise", format("%.3g mm at 3 m, growing with the square of the range", 1e3 * noise_m), "new for each ray", "yes"},
      {"Calibration of ranges", by_scenario(lab, &Scenario::common_sigma_m, 1e3, " mm"), "the same for all scans of a stand", "yes"},
      {"Pointing of a ray", by_scenario(lab, &Scenario::angle_noise_rad, 1e3, " mrad about each axis"), "new for each ray", "yes"},
      {"Pointing of the head", by_scenario(lab, &Scenario::common_sigma_rad, degrees, "° about each axis"),
       "the same for all scans of a stand", "yes"},
      {"Foil and tape: no light returns",
       by_scenario(lab, &Scenario::dropout_probability, 100, " % of the rays") + ", and where they graze by more than " +
           by_scenario(lab, &Scenario::dropout_incidence_rad, degrees, "°"),
       "new for each ray", "fewer rays"},
      {"Foil and tape: a wrong range", by_scenario(lab, &Scenario::outlier_probability, 100, " % of the rays"), "new for each ray",
       "fewer rays"},
      {"The mock-up against its model", by_scenario(lab, &Scenario::model_vertex_sigma_m, 1e3, " mm, each vertex along each axis"),
       "the same for all stands at a range", "yes"}};
  return to_html(html);
}

std::string budget_table(const LaboratoryResult& lab) {
  HtmlTable html;
  html.head = {"root mean square", "noise", "pointing", "calibration", "mock-up", "budget", "measured", "measured / budget", "stands"};
  for (const ShownFigure& shown : kShownFigures) {
    const FigureErrors errors = figure_errors(lab, shown.figure);
    std::vector<std::string> row = {format("%s, %s", shown.title, shown.unit)};
    for (const double part : errors.budget_by_source) row.push_back(number(part, shown));
    for (const double value : {errors.budget, errors.rms}) row.push_back(number(value, shown));
    row.push_back(format("<span class='%s'>%s</span>", errors.held() ? "good" : "bad", known(errors.ratio(), 2, "–").c_str()));
    row.push_back(format("%zu", errors.count));
    html.rows.push_back(row);
  }
  return to_html(html);
}

std::string ranges_table(const LaboratoryResult& lab) {
  HtmlTable html;
  html.head = {"range", "frames", "lost", "not valid"};
  for (const ShownFigure& shown : kShownFigures) html.head.push_back(format("%s, %s: measured (budget)", shown.title, shown.unit));
  for (std::size_t r = 0; r < lab.ranges.size(); ++r) {
    std::size_t frames = 0, lost = 0, invalid = 0;
    for (const StandResult& stand : lab.ranges[r].stands) {
      frames += stand.frames;
      lost += stand.lost;
      invalid += stand.invalid;
    }
    std::vector<std::string> row = {format("%g m", lab.ranges[r].range_m)};
    for (const std::size_t count : {frames, lost, invalid}) row.push_back(format("%zu", count));
    for (const ShownFigure& shown : kShownFigures) {
      const FigureErrors errors = figure_errors(lab, shown.figure, r);
      row.push_back(number(errors.rms, shown) + " <small>(" + number(errors.budget, shown) + ")</small>");
    }
    html.rows.push_back(row);
  }
  return to_html(html);
}

double stand_angle_deg(const LaboratoryResult& lab, std::size_t stand) { return 360.0 * static_cast<double>(stand) / lab.stands; }

// Of one range: a line a stand, all mock-ups.
std::string stands_text(const LaboratoryResult& lab, std::size_t range, const ShownFigure& shown) {
  std::string text;
  const std::vector<StandResult>& stands = lab.ranges[range].stands;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const double error = stands[i].errors[static_cast<std::size_t>(shown.figure)];
    if (std::isfinite(error)) text += format("%g %.5g\n", stand_angle_deg(lab, i % lab.stands), shown.scale * error);
  }
  return text;
}

// The budget of each stand, over all ranges: angle, minus, plus.
std::string budget_text(const LaboratoryResult& lab, const ShownFigure& shown) {
  std::string text;
  const bool compared = shown.figure == LaboratoryFigure::kZStep || shown.figure == LaboratoryFigure::kTurnStep;
  for (std::size_t stand = compared ? 1 : 0; stand < lab.stands; ++stand) {
    double variance = 0;
    for (const LaboratoryRange& range : lab.ranges)
      variance += total(range.budget[stand][static_cast<std::size_t>(shown.figure)]) / static_cast<double>(lab.ranges.size());
    const double sigma = shown.scale * std::sqrt(variance);
    text += format("%g %.5g %.5g\n", stand_angle_deg(lab, stand), -sigma, sigma);
  }
  return text;
}

std::vector<Curve> stand_curves(const LaboratoryResult& lab, const ShownFigure& shown) {
  std::vector<Curve> curves;
  for (std::size_t r = 0; r < lab.ranges.size(); ++r)
    curves.push_back({stands_text(lab, r, shown), 2,
                      format(" with points pt 7 ps 0.45 lc rgb '%s' title '%g m'", range_colour(r), lab.ranges[r].range_m)});
  const std::string budget = budget_text(lab, shown);
  curves.push_back({budget, 2, " with lines dt 2 lw 1.6 lc rgb '#2b3440' title 'budget, 1 sigma'"});
  curves.push_back({budget, 3, " with lines dt 2 lw 1.6 lc rgb '#2b3440' notitle"});
  return curves;
}

std::string stands_figure(Plotter& plotter, const LaboratoryResult& lab) {
  Drawing drawing(plotter);
  drawing.set(
      "set multiplot layout 1,2 margins 0.06,0.86,0.16,0.89 spacing 0.08,0\nset xrange [-8:353]\nset xtics 60\n"
      "set xlabel 'angle of the turntable, deg' textcolor '#46505f'\nset key at screen 0.998,0.92 right top vertical samplen 1.2 spacing "
      "1.3\n");
  bool first = true;
  for (const ShownFigure& shown : kDrawn) {
    drawing.set(format("%sset title '%s, %s'\n", first ? "" : "unset key\n", shown.title, shown.unit));
    drawing.plot(stand_curves(lab, shown), "every frame is lost");
    first = false;
  }
  return drawing.svg(1080, 400);
}

std::string range_lines(const LaboratoryResult& lab, const ShownFigure& shown) {
  std::string text;
  for (std::size_t r = 0; r < lab.ranges.size(); ++r) {
    const FigureErrors errors = figure_errors(lab, shown.figure, r);
    text += format("%g %.5g %.5g\n", lab.ranges[r].range_m, shown.scale * errors.rms, shown.scale * errors.budget);
  }
  return text;
}

std::string ranges_figure(Plotter& plotter, const LaboratoryResult& lab) {
  Drawing drawing(plotter);
  drawing.set(
      "set multiplot layout 1,2 margins 0.06,0.86,0.18,0.87 spacing 0.08,0\nset yrange [0:*]\n"
      "set xlabel 'range, m' textcolor '#46505f'\nset key at screen 0.998,0.91 right top vertical samplen 1.5 spacing 1.3\n");
  drawing.set(format("set xrange [%g:%g]\n", lab.ranges.front().range_m - 0.2, lab.ranges.back().range_m + 0.2));
  bool first = true;
  for (const ShownFigure& shown : kDrawn) {
    const std::string lines = range_lines(lab, shown);
    drawing.set(format("%sset title '%s, %s'\n", first ? "" : "unset key\n", shown.title, shown.unit));
    drawing.plot({{lines, 2, " with linespoints pt 7 ps 0.7 lw 1.6 lc rgb '#2563b8' title 'measured'"},
                  {lines, 3, " with linespoints pt 6 ps 0.7 dt 2 lw 1.6 lc rgb '#2b3440' title 'budget'"}},
                 "every frame is lost");
    first = false;
  }
  return drawing.svg(1080, 340);
}

std::string beside_paper(const LaboratoryResult& lab) {
  const FigureErrors z = figure_errors(lab, LaboratoryFigure::kZ), turn = figure_errors(lab, LaboratoryFigure::kTurnStep);
  HtmlTable html;
  html.head = {"mean ± std of the absolute errors of stands", "paper, 2005: table 2", "here, simulated"};
  const auto cell = [](double mean, double std, int digits) {
    return known(mean, digits, "–") + " <small>±</small> " + known(std, digits, "–");
  };
  html.rows = {{"Z, mm", cell(kPaperTable2.z_mean_mm, kPaperTable2.z_std_mm, 2), cell(1e3 * z.mean_abs, 1e3 * z.std_abs, 2)},
               {"Rotation about the axis, from stand to stand, deg", cell(kPaperTable2.turn_mean_deg, kPaperTable2.turn_std_deg, 2),
                cell(turn.mean_abs / kRadPerDeg, turn.std_abs / kRadPerDeg, 2)}};
  return to_html(html);
}

}  // namespace

std::string laboratory_section(Plotter& plotter, const LaboratoryResult& lab) {
  std::string html = "<section>\n<h2>Laboratory test, simulated (the paper's table 2)</h2>\n";
  html += format(
      "<p class='note'>No laboratory was at hand: sensor and mock-up are simulated. A tenth-scale Hubble on a turntable, %zu ranges from "
      "%g to "
      "%g m, %u stands %g° apart, %u scans each; at each range %u mock-ups, each with errors of its own. A stand's estimate is the mean of "
      "its scans. How the paper forms its errors of Z, and whether its means are of absolute values, is not known here.</p>\n",
      lab.ranges.size(), lab.ranges.front().range_m, lab.ranges.back().range_m, lab.stands, 360.0 / lab.stands, lab.frames, lab.mock_ups);
  html += beside_paper(lab);
  html +=
      "<h3>Assumptions</h3>\n<p class='note'>The sizes are assumptions of this project, but for the range noise. Those of the paper's "
      "laboratory are not known here.</p>\n" +
      assumptions_table(lab);
  html +=
      "<h3>Budget</h3>\n<p class='note'>The budget propagates the assumptions through the Jacobian of a least-squares pose of the planned "
      "rays. It is made before the "
      "test, without any estimate. Contours, which the component uses as well, are not in it. It is held where measured errors are at most "
      "1.1 times it.</p>\n" +
      budget_table(lab);
  html += "<details><summary>The same by range</summary>" + ranges_table(lab) + "</details>\n";
  html += figure(stands_figure(plotter, lab),
                 "Errors of the stands against the turntable's angle, all mock-ups; dashed, the budget over all ranges.");
  html += figure(ranges_figure(plotter, lab), "Root mean square errors of the stands against the range, and the budget.");
  return html + "</section>\n";
}

}  // namespace lasso::mdat
