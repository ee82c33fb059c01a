#include "mdat/report/timeline_view.hpp"

#include <algorithm>

#include "mdat/common/text.hpp"
#include "mdat/report/page.hpp"
#include "mdat/report/plot_style.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kModeColours[] = {"#8a94a3", "#d9a300", "#1e9aa8", "#2563b8", "#a3123a", "#d4571e", "#6b2b86", "#5aaf4a"};

std::size_t mode_index(TrackingMode mode) { return static_cast<std::size_t>(mode); }

// One line a stretch of time in one mode: begin, end, mode.
std::string stretches_text(const Timeline& timeline) {
  const std::vector<TimelinePoint>& points = timeline.points;
  std::string text;
  for (std::size_t i = 0, begin = 0; i < points.size(); ++i) {
    if (i + 1 < points.size() && points[i + 1].mode == points[begin].mode) continue;
    const double end_s = points[std::min(i + 1, points.size() - 1)].t_s;
    text += format("%.3f %.3f %zu\n", points[begin].t_s, end_s, mode_index(points[begin].mode));
    begin = i + 1;
  }
  return text;
}

// Time, true range, then the errors of a valid pose in mm and degrees, apart for right (or covered) and wrong ones.
std::string points_text(const Timeline& timeline) {
  std::string text;
  for (const TimelinePoint& point : timeline.points) {
    text += format("%.3f %.4f ", point.t_s, point.range_m);
    const std::string errors = format("%.4g %.4g", std::max(1e-3, 1e3 * point.registration.translation_m.norm()),
                                      std::max(1e-5, point.registration.rotation_rad / kRadPerDeg));
    const bool wrong = point.verdict == PoseVerdict::kWrong;
    text += (point.valid && !wrong ? errors : "NaN NaN") + " " + (point.valid && wrong ? errors : "NaN NaN") + "\n";
  }
  return text;
}

std::string mode_tics() {
  std::string text = "set ytics (";
  for (const ModeProperties& mode : mode_properties()) {
    text += format("%s'%s' %zu", mode_index(mode.mode) > 0 ? ", " : "", mode.name, mode_index(mode.mode));
  }
  return text + ")\n";
}

std::string mode_panel(const std::string& stretches) {
  std::string text =
      mode_tics() + format("set yrange [-0.7:%g]\nset title 'mode'\nplot ", static_cast<double>(mode_properties().size()) - 0.3);
  for (std::size_t i = 0; i < mode_properties().size(); ++i) {
    text += format("%s%s using 1:($3==%zu?$3:1/0):1:2:($3-0.32):($3+0.32) with boxxyerror fs solid noborder lc rgb '%s' notitle",
                   i > 0 ? ", " : "", stretches.c_str(), i, kModeColours[i % std::size(kModeColours)]);
  }
  return text + "\n";
}

std::string error_panel(const std::string& points, const char* title, int column) {
  return format(
      "set title '%s'\nplot %s using 1:%d with points pt 7 ps 0.22 lc rgb '#2563b8' notitle, "
      "%s using 1:%d with points pt 7 ps 0.5 lc rgb '#d4001a' notitle\n",
      title, points.c_str(), column, points.c_str(), column + 2);
}

std::string eclipse(const Scenario& scenario) {
  if (!(scenario.eclipse_s[1] > scenario.eclipse_s[0])) return "";
  return format("set object 1 rectangle from first %g, graph 0 to first %g, graph 1 behind fc rgb '#dfe3ea' fs solid noborder\n",
                scenario.eclipse_s[0], scenario.eclipse_s[1]);
}

std::string changes_table(const Timeline& timeline) {
  HtmlTable html;
  html.head = {"time, s", "from", "event", "to", "meaning"};
  for (const TimelineChange& change : timeline.changes) {
    html.rows.push_back(
        {format("%.1f", change.t_s), to_string(change.from), to_string(change.event), to_string(change.to), meaning(change)});
  }
  return to_html(html);
}

std::string statistics_table(const TimelineStatistics& run) {
  HtmlTable html;
  html.head = {"frames", "with a valid pose", "of these wrong", "rms, mm", "rms, deg", "worst, mm", "worst, deg", "NEES"};
  html.rows.push_back({format("%zu", run.frames), format("%zu", run.valid), format("%zu", run.wrong), format("%.2f", run.rms_mm),
                       format("%.4f", run.rms_deg), format("%.1f", run.worst_mm), format("%.3f", run.worst_deg), format("%.2f", run.nees)});
  return to_html(html);
}

}  // namespace

std::string timeline_figure(Plotter& plotter, const Scenario& scenario, const Timeline& timeline) {
  const std::string stretches = plotter.data(stretches_text(timeline)), points = plotter.data(points_text(timeline));
  std::string script = kPlotStyle;
  script += "set multiplot layout 4,1 margins 0.1,0.98,0.08,0.96 spacing 0,0.055\nset format x ''\n" + eclipse(scenario);
  script += format("set xrange [0:%g]\nset datafile missing 'NaN'\n", timeline.points.empty() ? 1 : timeline.points.back().t_s);
  script += mode_panel(stretches) + "set ytics autofreq\nset yrange [*:*]\nset logscale y\nset format y '%g'\n";
  script += format("set title 'true range, m'\nplot %s using 1:2 with lines lw 1.4 lc rgb '#1b2a6b' notitle\n", points.c_str());
  script += error_panel(points, "error of valid poses, mm", 3) + "set format x '%g'\nset xlabel 'time, s' textcolor '#46505f'\n";
  return plotter.svg(1080, 860, script + error_panel(points, "error of valid poses, deg", 4) + "unset multiplot\n");
}

std::string timeline_section(Plotter& plotter, const TableResult& table) {
  const Timeline& timeline = table.variants.front().cases.front().timeline;
  return "<section>\n<h2>Through the modes</h2>\n" +
         figure(timeline_figure(plotter, table.scenario, timeline),
                "The component's mode, the target's true range, and the errors of all poses that it called valid (red: wrong). Grey: the "
                "target is hidden.") +
         "<h2>Poses</h2>\n" + statistics_table(timeline_statistics(timeline)) + "<h2>Changes of the mode</h2>\n" + changes_table(timeline) +
         "</section>\n";
}

}  // namespace lasso::mdat
