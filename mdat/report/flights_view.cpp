#include "mdat/report/flights_view.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "mdat/common/text.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/report/figures.hpp"
#include "mdat/report/page.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kFlightColour = "#9fd3d8";  // of one among many; all together are dark
constexpr const char* kAllColour = "#1b2a6b";
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> settled_row(const std::string& name, const SettledStatistics& run) {
  std::vector<std::string> row = {name, format("%zu", run.frames), format("%zu", run.lost), format("%zu", run.invalid)};
  for (const double degps : {run.rms_degps, run.worst_degps}) row.push_back(known(run.frames > 0 ? degps : kNothing, 3, "–"));
  for (const double mmps : {run.rms_mmps, run.worst_mmps}) row.push_back(known(run.frames > 0 ? mmps : kNothing, 2, "–"));
  return row;
}

HtmlTable settled_head() {
  HtmlTable html;
  html.head = {format("after %zu frames of each flight", kSettlingFrames),
               "frames",
               "lost",
               "without valid pose",
               "rates: rms, deg/s",
               "worst",
               "rms, mm/s",
               "worst"};
  return html;
}

double degps(const FrameError& frame) { return frame.omega_error_radps / kRadPerDeg; }
double mmps(const FrameError& frame) { return 1e3 * frame.v_error_mps; }

std::string rates_text(const CaseResult& flight) {
  std::string text;
  for (std::size_t frame = 0; frame < flight.frames.size(); ++frame) {
    const FrameError& error = flight.frames[frame];
    text += error.reported ? format("%zu %.4g %.4g\n", frame, degps(error), mmps(error)) : "\n";
  }
  return text;
}

// Of all flights that are reported in a frame.
std::string mean_rates_text(const VariantResult& variant) {
  std::string text;
  for (std::size_t frame = 0; frame < longest_run(variant); ++frame) {
    double degps2 = 0, mmps2 = 0, flights = 0;
    for (const CaseResult& flight : variant.cases) {
      if (frame >= flight.frames.size() || !flight.frames[frame].reported) continue;
      degps2 += std::pow(degps(flight.frames[frame]), 2);
      mmps2 += std::pow(mmps(flight.frames[frame]), 2);
      ++flights;
    }
    text += flights > 0 ? format("%zu %.4g %.4g\n", frame, std::sqrt(degps2 / flights), std::sqrt(mmps2 / flights)) : "\n";
  }
  return text;
}

// A line a flight, and one of all.
std::vector<Curve> rates_curves(const VariantResult& variant, int column) {
  std::vector<Curve> curves;
  for (const CaseResult& flight : variant.cases)
    curves.push_back({rates_text(flight), column,
                      format(" with lines lw 0.8 lc rgb '%s' %s", kFlightColour, curves.empty() ? "title 'a flight'" : "notitle")});
  curves.push_back({mean_rates_text(variant), column, format(" with lines lw 1.8 lc rgb '%s' title 'rms of all'", kAllColour)});
  return curves;
}

// Where the filter counts as settled.
std::string settled_line(std::size_t frames) {
  if (frames <= kSettlingFrames) return "";
  return format("set arrow 1 from first %zu, graph 0 to first %zu, graph 1 nohead lw 0.8 dt 3 lc rgb '#d4571e' front\n", kSettlingFrames,
                kSettlingFrames) +
         format("set label 1 'settled' at first %zu, graph 0.95 offset 0.6,0 textcolor '#d4571e'\n", kSettlingFrames);
}

using FlightValue = std::function<double(const RunStatistics&)>;

const std::pair<const char*, FlightValue> kFlightPanels[] = {
    {"registration, mm", [](const RunStatistics& run) { return run.lost < run.frames ? run.registration.rms_mm : kNothing; }},
    {"registration, deg", [](const RunStatistics& run) { return run.lost < run.frames ? run.registration.rms_deg : kNothing; }},
    {"settled rates, deg/s", [](const RunStatistics& run) { return run.settled.frames > 0 ? run.settled.rms_degps : kNothing; }},
    {"settled rates, mm/s", [](const RunStatistics& run) { return run.settled.frames > 0 ? run.settled.rms_mmps : kNothing; }}};

// Flight and value, which is not a number where it is not known.
std::string flights_text(const VariantResult& variant, const FlightValue& value) {
  std::string text;
  for (std::size_t i = 0; i < variant.by_range.size(); ++i) text += format("%zu %.6g\n", i + 1, value(variant.by_range[i]));
  return text;
}

}  // namespace

std::string settled_section(const TableResult& table) {
  HtmlTable all = settled_head(), each = settled_head();
  for (const VariantResult& variant : table.variants) {
    all.rows.push_back(settled_row(variant.variant.title, variant.all.settled));
    for (std::size_t i = 0; i < variant.by_range.size(); ++i)
      each.rows.push_back(
          settled_row(std::string(variant.variant.title) + ", " + run_text(table.scenario, i), variant.by_range[i].settled));
  }
  return to_html(all) + "<details><summary>The same by flight</summary>" + to_html(each) + "</details>\n";
}

std::string rates_figure(Plotter& plotter, const VariantResult& variant) {
  const std::size_t frames = longest_run(variant);
  Drawing drawing(plotter);
  drawing.set("set multiplot layout 1,2 margins 0.06,0.86,0.18,0.88 spacing 0.07,0\nset format y '%g'\n");
  drawing.set(format(
      "set xrange [0:%zu]\nset xlabel 'frame' textcolor '#46505f'\nset key at screen 0.998,0.88 right top vertical samplen 1.5 spacing "
      "1.3\n",
      frames));
  drawing.set(settled_line(frames) + "set title 'rotation, deg/s'\n");
  drawing.plot(rates_curves(variant, 2), "no rate is known", Axis::kLogarithmic);
  drawing.set("unset key\nset title 'translation, mm/s'\n");
  drawing.plot(rates_curves(variant, 3), "no rate is known", Axis::kLogarithmic);
  return drawing.svg(1080, 380);
}

std::string flights_figure(Plotter& plotter, const VariantResult& variant) {
  Drawing drawing(plotter);
  drawing.set(format("set multiplot layout 1,%zu margins 0.05,0.985,0.23,0.87 spacing 0.055,0\nunset key\nset yrange [0:*]\n",
                     std::size(kFlightPanels)));
  const std::size_t flights = variant.cases.size();
  drawing.set(format("set xrange [0.4:%g]\nset xtics %zu\nset xlabel 'flight' textcolor '#46505f'\n", static_cast<double>(flights) + 0.6,
                     flights / 8 + 1));
  for (const auto& [title, value] : kFlightPanels) {
    drawing.set(format("set title '%s'\n", title));
    drawing.plot({{flights_text(variant, value), 2, format(" with impulses lw 4 lc rgb '%s' notitle", kFlightColour)}}, "not known");
  }
  return drawing.svg(1080, 300);
}

}  // namespace lasso::mdat
