#include "mdat/report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mdat/common/text.hpp"
#include "mdat/report/doubtful_view.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

// From near (dark blue) to far (orange): distinct on white, in print and for most colour-blind readers.
constexpr const char* kRangeColours[] = {"#1b2a6b", "#2563b8", "#1e9aa8", "#5aaf4a", "#d9a300", "#d4571e", "#a3123a", "#6b2b86"};
constexpr std::size_t kRangeColourCount = std::size(kRangeColours);
constexpr const char* kVariantColours[] = {"#1e9aa8", "#d4571e", "#2563b8", "#a3123a", "#8a6d00"};  // one for each of kVariants

const char* variant_colour(std::size_t i) { return kVariantColours[i % std::size(kVariantColours)]; }

double error_of(const PoseError& error, std::size_t axis) {
  const int i = static_cast<int>(axis % 3);
  return axis < 3 ? 1e3 * error.translation_m[i] : error.yaw_pitch_roll[i] / kRadPerDeg;
}

// One line a frame: abscissa, then the six errors; a gap where the frame is lost.
std::string errors_text(const CaseResult& run, double abscissa_step) {
  std::string text;
  for (std::size_t frame = 0; frame < run.frames.size(); ++frame) {
    const FrameError& error = run.frames[frame];
    if (error.lost()) {
      text += "\n";
      continue;
    }
    text += format("%g", static_cast<double>(frame) * abscissa_step);
    for (std::size_t axis = 0; axis < 6; ++axis) text += format(" %.4g", error_of(error.registration, axis));
    text += "\n";
  }
  return text;
}

// Far ranges first, so that near ones (with smaller errors) lie on top.
std::vector<Curve> angle_curves(const std::vector<std::string>& runs, const Scenario& scenario, std::size_t axis) {
  std::vector<Curve> curves;
  for (std::size_t i = runs.size(); i-- > 0;) {
    const std::string style = format(" with lines lw 0.8 lc rgb '%s' title '%s'", range_colour(i), run_text(scenario, i).c_str());
    curves.push_back({runs[i], static_cast<int>(axis) + 2, style});
  }
  return curves;
}

// One line a range: range, rms in mm and degrees, bound in mm and degrees.
std::string ranges_text(const VariantResult& variant, const Scenario& scenario) {
  std::string text;
  for (std::size_t i = 0; i < variant.by_range.size(); ++i) {
    const RunStatistics& run = variant.by_range[i];
    text += format("%g %.6g %.6g %.6g %.6g\n", scenario.runs_m()[i], run.registration.rms_mm, run.registration.rms_deg, run.crlb_mm,
                   run.crlb_deg);
  }
  return text;
}

// Column 2 is the translation, column 3 the rotation; two further on is the bound.
std::vector<Curve> range_curves(const TableResult& table, int column) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < table.variants.size(); ++i) {
    const std::string style =
        format(" with linespoints pt 7 ps 0.6 lw 1.4 lc rgb '%s' title '%s'", variant_colour(i), table.variants[i].variant.title);
    curves.push_back({ranges_text(table.variants[i], table.scenario), column, style});
  }
  curves.push_back({ranges_text(table.variants.front(), table.scenario), column + 2,
                    " with lines dt 2 lw 1.4 lc rgb '#2b3440' title 'bound of the hits'"});
  return curves;
}

std::vector<double> all_times_us(const VariantResult& variant) {
  std::vector<double> times;
  for (const CaseResult& run : variant.cases) {
    for (const FrameError& frame : run.frames) {
      if (frame.reported) times.push_back(frame.estimate_us);
    }
  }
  return times;
}

std::string histogram_text(const std::vector<double>& times, double bin_us) {
  std::map<long, std::size_t> bins;
  for (const double time : times) ++bins[std::lround(std::floor(time / bin_us))];
  std::string text;
  for (const auto& [bin, count] : bins) {
    text += format("%g %g\n", (static_cast<double>(bin) + 0.5) * bin_us,
                   100.0 * static_cast<double>(count) / static_cast<double>(times.size()));
  }
  return text;
}

constexpr const char* kAllLost = "every frame is lost";

}  // namespace

const char* range_colour(std::size_t i) { return kRangeColours[i % kRangeColourCount]; }

std::size_t longest_run(const VariantResult& variant) {
  std::size_t frames = 0;
  for (const CaseResult& run : variant.cases) frames = std::max(frames, run.frames.size());
  return frames;
}

bool has_bound(const TableResult& table) {
  const std::vector<RunStatistics>& runs = table.variants.front().by_range;
  return std::any_of(runs.begin(), runs.end(), [](const RunStatistics& run) { return run.crlb_mm > 0; });
}

bool turns_by_steps(const TableResult& table) { return table.scenario.scene == nullptr && table.scenario.step_rad != 0; }

std::string error_against_angle(Plotter& plotter, const TableResult& table, const VariantResult& variant) {
  const bool turns = turns_by_steps(table);
  const double step = turns ? table.scenario.step_rad / kRadPerDeg : 1;
  std::vector<std::string> runs;
  for (const CaseResult& run : variant.cases) runs.push_back(errors_text(run, step));
  const std::vector<Curve> marks = doubtful_marks(variant, step);
  Drawing drawing(plotter);
  drawing.set(kMarksAxis);
  drawing.set("set format y '%.3g'\n");
  drawing.set(
      "set multiplot layout 2,3 margins 0.065,0.905,0.11,0.94 spacing 0.078,0.19\n"
      "set key at screen 0.998,0.955 right top vertical samplen 1.2 spacing 1.2\n");
  if (table.scenario.drawn != 0) drawing.set("unset key\n");  // flights have no order
  drawing.set(format("set xrange [0:%g]\n", step * static_cast<double>(longest_run(variant))));
  if (turns && longest_run(variant) > 180) drawing.set("set xtics 90\n");
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if (axis == 1) drawing.set("unset key\n");
    if (axis == 3) drawing.set(format("set xlabel '%s' textcolor '#46505f'\n", turns ? "turn about the x axis, deg" : "frame"));
    drawing.set(format("set title '%s, %s'\n", kErrorAxes[axis].name, kErrorAxes[axis].unit));
    std::vector<Curve> curves = angle_curves(runs, table.scenario, axis);
    curves.insert(curves.end(), marks.begin(), marks.end());
    drawing.plot(curves, kAllLost);
  }
  return drawing.svg(1080, 600);
}

std::string error_against_range(Plotter& plotter, const TableResult& table) {
  const std::vector<double> ranges_m = table.scenario.runs_m();
  const auto [nearest, farthest] = std::minmax_element(ranges_m.begin(), ranges_m.end());
  Drawing drawing(plotter);
  drawing.set("set multiplot layout 1,2 margins 0.06,0.79,0.18,0.91 spacing 0.07,0\nset format y '%g'\n");
  drawing.set(
      format("set xrange [%g:%g]\nset xlabel 'range, m' textcolor '#46505f'\n"
             "set key at screen 0.998,0.91 right top vertical samplen 1.5 spacing 1.3\n",
             *nearest - 0.2, *farthest + 0.2));
  drawing.set("set title 'translation, mm'\n");
  drawing.plot(range_curves(table, 2), kAllLost, Axis::kLogarithmic);
  drawing.set("unset key\nset title 'rotation, deg'\n");
  drawing.plot(range_curves(table, 3), kAllLost, Axis::kLogarithmic);
  return drawing.svg(1080, 380);
}

std::string time_histogram(Plotter& plotter, const TableResult& table) {
  double p99_us = 1;
  for (const VariantResult& variant : table.variants) p99_us = std::max(p99_us, variant.all.time.p99_us);
  const double limit_us = 1.3 * p99_us, bin_us = limit_us / 130;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < table.variants.size(); ++i) {
    const std::string style = format(" with histeps lw 1.4 lc rgb '%s' title '%s'", variant_colour(i), table.variants[i].variant.title);
    curves.push_back({histogram_text(all_times_us(table.variants[i]), bin_us), 2, style});
  }
  Drawing drawing(plotter);
  drawing.set("set xlabel 'processor time of an estimate, us' textcolor '#46505f'\nset ylabel 'share of frames, %' textcolor '#46505f'\n");
  drawing.set(format("set xrange [0:%g]\nset yrange [0:*]\nset key top right\n", limit_us));
  drawing.plot(curves, "no scan was registered");
  return drawing.svg(1080, 330);
}

}  // namespace lasso::mdat
