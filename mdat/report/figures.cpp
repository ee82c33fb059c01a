#include "mdat/report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mdat/common/text.hpp"
#include "mdat/report/plot_style.hpp"
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
std::string angle_panel(const std::vector<std::string>& files, const Scenario& scenario, std::size_t axis) {
  std::string text = format("set title '%s, %s'\nplot ", kErrorAxes[axis].name, kErrorAxes[axis].unit);
  for (std::size_t i = files.size(); i-- > 0;) {
    text += format("%s using 1:%zu with lines lw 0.8 lc rgb '%s' title '%s'%s", files[i].c_str(), axis + 2,
                   kRangeColours[i % kRangeColourCount], run_text(scenario, i).c_str(), i > 0 ? ", " : "\n");
  }
  return text;
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

std::string range_panel(const std::vector<std::string>& files, const TableResult& table, bool rotation) {
  const int column = rotation ? 3 : 2;
  std::string text = rotation ? "set title 'rotation, deg'\nplot " : "set title 'translation, mm'\nplot ";
  for (std::size_t i = 0; i < files.size(); ++i) {
    text += format("%s%s using 1:%d with linespoints pt 7 ps 0.6 lw 1.4 lc rgb '%s' title '%s'", i > 0 ? ", " : "", files[i].c_str(),
                   column, variant_colour(i), table.variants[i].variant.title);
  }
  if (!has_bound(table)) return text + "\n";
  return text + format(", %s using 1:%d with lines dt 2 lw 1.4 lc rgb '#2b3440' title 'bound of the hits'\n", files[0].c_str(), column + 2);
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
  return text + "\n";
}

}  // namespace

bool is_tracked(const VariantResult& variant) { return variant.all.lost < variant.all.frames; }

std::size_t longest_run(const VariantResult& variant) {
  std::size_t frames = 0;
  for (const CaseResult& run : variant.cases) frames = std::max(frames, run.frames.size());
  return frames;
}

bool has_bound(const TableResult& table) {
  const std::vector<RunStatistics>& runs = table.variants.front().by_range;
  return std::any_of(runs.begin(), runs.end(), [](const RunStatistics& run) { return run.crlb_mm > 0; });
}

bool turns_by_steps(const TableResult& table) {
  return table.scenario.scenario_kind() == ScenarioKind::kPaper && table.scenario.step_rad != 0;
}

std::string error_against_angle(Plotter& plotter, const TableResult& table, const VariantResult& variant) {
  if (!is_tracked(variant)) return plotter.svg(1080, 120, nothing_to_draw("every frame is lost"));
  const bool turns = turns_by_steps(table);
  const double step = turns ? table.scenario.step_rad / kRadPerDeg : 1;
  std::vector<std::string> files;
  for (const CaseResult& run : variant.cases) files.push_back(plotter.data(errors_text(run, step)));
  std::string script = kPlotStyle;
  script +=
      "set multiplot layout 2,3 margins 0.06,0.925,0.125,0.93 spacing 0.062,0.14\n"
      "set key at screen 0.998,0.95 right top vertical samplen 1.2 spacing 1.2\n";
  if (table.scenario.drawn != 0) script += "unset key\n";  // flights have no order
  script += format("set xrange [0:%g]\n", step * static_cast<double>(longest_run(variant)));
  if (turns && longest_run(variant) > 180) script += "set xtics 90\n";
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if (axis == 1) script += "unset key\n";
    if (axis == 3) script += format("set xlabel '%s' textcolor '#46505f'\n", turns ? "turn about the x axis, deg" : "frame");
    script += angle_panel(files, table.scenario, axis);
  }
  return plotter.svg(1080, 560, script + "unset multiplot\n");
}

std::string error_against_range(Plotter& plotter, const TableResult& table) {
  if (std::none_of(table.variants.begin(), table.variants.end(), is_tracked))
    return plotter.svg(1080, 120, nothing_to_draw("every frame is lost"));
  std::vector<std::string> files;
  for (const VariantResult& variant : table.variants) files.push_back(plotter.data(ranges_text(variant, table.scenario)));
  const std::vector<double> ranges_m = table.scenario.runs_m();
  const auto [nearest, farthest] = std::minmax_element(ranges_m.begin(), ranges_m.end());
  std::string script = kPlotStyle;
  script += "set multiplot layout 1,2 margins 0.06,0.79,0.18,0.91 spacing 0.07,0\nset logscale y\nset format y '%g'\n";
  script += format(
      "set xrange [%g:%g]\nset xlabel 'range, m' textcolor '#46505f'\n"
      "set key at screen 0.998,0.91 right top vertical samplen 1.5 spacing 1.3\n",
      *nearest - 0.2, *farthest + 0.2);
  script += range_panel(files, table, false) + "unset key\n" + range_panel(files, table, true);
  return plotter.svg(1080, 380, script + "unset multiplot\n");
}

std::string time_histogram(Plotter& plotter, const TableResult& table) {
  double p99_us = 1;
  for (const VariantResult& variant : table.variants) p99_us = std::max(p99_us, variant.all.time.p99_us);
  const double limit_us = 1.3 * p99_us, bin_us = limit_us / 130;
  std::string script = kPlotStyle;
  script += "set xlabel 'processor time of an estimate, us' textcolor '#46505f'\nset ylabel 'share of frames, %' textcolor '#46505f'\n";
  script += format("set xrange [0:%g]\nset yrange [0:*]\nset key top right\nplot ", limit_us);
  for (std::size_t i = 0; i < table.variants.size(); ++i) {
    const std::string file = plotter.data(histogram_text(all_times_us(table.variants[i]), bin_us));
    script += format("%s%s with histeps lw 1.4 lc rgb '%s' title '%s'", i > 0 ? ", " : "", file.c_str(), variant_colour(i),
                     table.variants[i].variant.title);
  }
  return plotter.svg(1080, 330, script + "\n");
}

}  // namespace lasso::mdat
