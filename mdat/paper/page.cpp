#include "mdat/paper/page.hpp"

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/paper/laboratory_view.hpp"
#include "mdat/paper/results.hpp"
#include "mdat/report/figures.hpp"
#include "mdat/report/page.hpp"
#include "mdat/run/paper.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

std::string cell(const MeanStd& value) { return small_number(value.mean) + " <small>±</small> " + small_number(value.std); }
std::string paper_cell(const MeanStd& value) { return format("%g <small>±</small> %g", value.mean, value.std); }

std::string simulation_table(const TableResult& table) {
  HtmlTable html;
  html.head = {"mean ± std", "paper, 2005: table 1, no noise"};
  for (const VariantResult& variant : table.variants) html.head.push_back(std::string("here, ") + variant.variant.title);
  const ErrorStatistics reference = paper_table_1();
  for (const ErrorAxis& axis : kErrorAxes) {
    std::vector<std::string> row = {format("%s, %s", axis.name, axis.unit), paper_cell(reference.*axis.member)};
    for (const VariantResult& variant : table.variants) row.push_back(cell(variant.all.registration.*axis.member));
    html.rows.push_back(row);
  }
  std::vector<std::string> lost = {"frames lost", "–"};
  for (const VariantResult& variant : table.variants) lost.push_back(format("%zu of %zu", variant.all.lost, variant.all.frames));
  html.rows.push_back(lost);
  return to_html(html);
}

std::string simulation_section(Plotter& plotter, const SimulationResult& simulation) {
  const TableResult& table = simulation.tables.front();
  std::string html = "<section>\n<h2>Simulation (the paper's table 1, figures 11 and 13)</h2>\n";
  html += format(
      "<p class='note'>A tenth-scale Hubble, %s, %u frames each, 1° a frame, tilted by 15°; closed loop through the flight component. The "
      "paper's "
      "simulation has no noise; the second column here has that of a laser camera, 1 mm at 3 m. The paper's curves are not known here, so "
      "its figures "
      "stand for this project alone.</p>\n",
      runs_text(table.scenario).c_str(), simulation.frames);
  html += simulation_table(table);
  for (const VariantResult& variant : table.variants)
    html += figure(error_against_angle(plotter, table, variant),
                   format("As the paper's figure 11: errors of single scans against the target's angle, %s.", variant.variant.title));
  html += figure(error_against_range(plotter, table),
                 "As the paper's figure 13: root mean square errors against the range, and the Cramér-Rao bound of the hits with noise.");
  return html + "</section>\n";
}

std::string ratio_cell(double paper_ms, double median_us) { return known(1e3 * paper_ms / median_us, 1, "–"); }

std::string time_section(const PaperResult& result) {
  HtmlTable html;
  html.head = {"", "median, ms", "99 %, ms", "share of one core at 5 scans a second", "9.2 ms / median", "148 ms / median"};
  const auto add = [&html](const std::string& name, const TimeStatistics& time) {
    html.rows.push_back({name, known(1e-3 * time.median_us, 2, "–"), known(1e-3 * time.p99_us, 2, "–"),
                         known(5e-4 * time.median_us, 2, "–") + " %", ratio_cell(kPaperTime.laptop_ms, time.median_us),
                         ratio_cell(kPaperTime.card_ms, time.median_us)});
  };
  for (const VariantResult& variant : result.simulation.tables.front().variants)
    add(std::string("Simulation, ") + variant.variant.title, variant.all.time);
  add("Laboratory test, simulated", result.laboratory.time);
  return "<section>\n<h2>Processing time</h2>\n" +
         format(
             "<p class='note'>The paper: 9.2 ms a frame on a 1.6 GHz Pentium M, 148 ms on a PowerPC 603e. Here: processor time of an "
             "estimate (range image in, "
             "pose and covariance out) on one core of %s. The machines differ: the ratios are of machines and programs together. What an "
             "estimate takes on the "
             "603e is counted by <code>make count WHAT=estimate</code>.</p>\n",
             escape(result.machine).c_str()) +
         to_html(html) + "</section>\n";
}

std::string items_section() {
  HtmlTable html;
  html.words = true;
  html.head = {"in the paper", "what it shows", "here"};
  for (const PaperItem& item : paper_items()) html.rows.push_back({escape(item.name), escape(item.shows), escape(item.here)});
  return "<section>\n<h2>Tables and figures of the paper</h2>\n<p class='note'>Known here means: stated in this project's own files. "
         "Nothing is guessed in "
         "place of what is not.</p>\n" +
         to_html(html) + "</section>\n";
}

std::string overview(const PaperResult& result) {
  HtmlTable html;
  html.head = {"mean ± std", "unit", "paper, 2005", "here, no noise", "here, with noise"};
  for (const PaperRow& row : paper_rows(result))
    html.rows.push_back({escape(row.what), row.unit, row.paper, row.here.empty() ? "–" : row.here, row.noisy});
  return "<section>\n<h2>The paper and this program</h2>\n" + to_html(html) +
         "<p class='note'>Table 2 and what stands beside it: mean and standard deviation of absolute errors.</p></section>\n";
}

}  // namespace

std::string paper_html(Plotter& plotter, const PaperResult& result) {
  const std::string title = "The experiments of the 3DLASSO paper (2005), repeated in simulation";
  std::string body = "<h1>" + title + "</h1>\n";
  body += format("<p class='lead'>mdat %s%s%s, %.0f s. All of it is simulated, the laboratory test as well.</p>\n", kVersion,
                 result.commit.empty() ? "" : ", commit ", escape(result.commit).c_str(), result.seconds);
  body += overview(result) + simulation_section(plotter, result.simulation) + laboratory_section(plotter, result.laboratory);
  body += time_section(result) + items_section();
  return page(title, body);
}

}  // namespace lasso::mdat
