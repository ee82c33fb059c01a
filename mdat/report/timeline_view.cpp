#include "mdat/report/timeline_view.hpp"

#include <algorithm>
#include <map>

#include "mdat/common/text.hpp"
#include "mdat/report/doubtful_view.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/report/page.hpp"
#include "mdat/report/scan_view.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kColours[] = {"#8a94a3", "#d9a300", "#1e9aa8", "#2563b8", "#a3123a", "#d4571e", "#6b2b86", "#5aaf4a", "#1b2a6b"};
constexpr double kLabelGap = 0.025;  // of the picture's width: events closer than this share a label

const Scenario& scenario_of(const SimulationResult& result) { return result.tables.front().scenario; }
const CaseResult& run_of(const SimulationResult& result) { return result.tables.front().variants.front().cases.front(); }

double end_of(const Timeline& timeline) { return timeline.points.empty() ? 1 : timeline.points.back().t_s; }

// A panel of bars: what the rows are called, and which one each point is in.
struct Bars {
  const char* title;
  std::vector<std::string> rows;
  std::size_t (*row_of)(const TimelinePoint&);
};

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (const ModeProperties& mode : mode_properties()) names.emplace_back(mode.name);
  return names;
}

// One line a stretch of time in a row: begin, row, end.
std::string stretches_text(const Timeline& timeline, const Bars& bars, std::size_t row) {
  const std::vector<TimelinePoint>& points = timeline.points;
  std::string text;
  for (std::size_t i = 0, begin = 0; i < points.size(); ++i) {
    if (i + 1 < points.size() && bars.row_of(points[i + 1]) == bars.row_of(points[begin])) continue;
    const double end_s = points[std::min(i + 1, points.size() - 1)].t_s;
    if (bars.row_of(points[begin]) == row) text += format("%.3f %zu %.3f\n", points[begin].t_s, row, end_s);
    begin = i + 1;
  }
  return text;
}

// The first row stands at the top.
void draw_bars(Drawing& drawing, const Timeline& timeline, const Bars& bars) {
  std::string tics;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < bars.rows.size(); ++i) {
    tics += format("%s'%s' %zu", i > 0 ? ", " : "", plain(bars.rows[i]).c_str(), i);
    const char* pattern = ":1:3:($2-0.34):($2+0.34) with boxxyerror fs solid noborder lc rgb '%s' notitle";
    curves.push_back({stretches_text(timeline, bars, i), 2, format(pattern, kColours[i % std::size(kColours)])});
  }
  drawing.set(format("set ytics (%s)\nset yrange [%g:-0.7]\nset title '%s'\n", tics.c_str(), static_cast<double>(bars.rows.size()) - 0.3,
                     bars.title));
  drawing.plot(curves, "no packet");
}

// Time, true range, then the errors of valid poses in mm and degrees: of single scans that are right (or covered), of those that are
// wrong, and of the filter.
std::string points_text(const Timeline& timeline) {
  const auto errors = [](const PoseError& error, bool shown) {
    if (!shown) return std::string(" NaN NaN");
    return format(" %.4g %.4g", std::max(1e-3, 1e3 * error.translation_m.norm()), std::max(1e-5, error.rotation_rad / kRadPerDeg));
  };
  std::string text;
  for (const TimelinePoint& point : timeline.points) {
    const bool wrong = point.verdict == PoseVerdict::kWrong;
    text += format("%.3f %.4f", point.t_s, point.range_m) + errors(point.registration, point.valid && !wrong) +
            errors(point.registration, point.valid && wrong) + errors(point.filtered, point.valid) + "\n";
  }
  return text;
}

// Times of poses that are not valid, at the lower edge.
std::string invalid_text(const Timeline& timeline) {
  std::string text;
  for (const TimelinePoint& point : timeline.points) text += point.valid ? "" : format("%.3f 0.025\n", point.t_s);
  return text;
}

void draw_errors(Drawing& drawing, const std::string& points, const std::string& invalid, const char* title, int column) {
  drawing.set(format("set title '%s'\n", title));
  drawing.plot({{points, column, " with points pt 7 ps 0.2 lc rgb '#8fb3ea' notitle"},
                {points, column + 4, " with points pt 7 ps 0.16 lc rgb '#1b2a6b' notitle"},
                {points, column + 2, " with points pt 7 ps 0.5 lc rgb '#d4001a' notitle"},
                {invalid, 2, " axes x1y2 with points pt 9 ps 0.4 lc rgb '#d9a300' notitle", true}},
               "no valid pose", Axis::kLogarithmic);
}

void draw_range(Drawing& drawing, const Timeline& timeline, const std::string& points) {
  double nearest_m = 1e9, farthest_m = 1e-9;
  for (const TimelinePoint& point : timeline.points) {
    nearest_m = std::min(nearest_m, point.range_m);
    farthest_m = std::max(farthest_m, point.range_m);
  }
  const bool wide = farthest_m > 4 * nearest_m;  // so that several of these tics are on the axis
  drawing.set(format("set yrange [%g:%g]\n", 0.8 * nearest_m, 1.25 * farthest_m));
  if (wide) drawing.set("set ytics (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)\n");
  if (!wide) drawing.set("set ytics autofreq\n");
  drawing.set("set title 'true range of the origin, m'\n");
  drawing.plot({{points, 2, " with lines lw 1.4 lc rgb '#1b2a6b' notitle"}}, "no packet", wide ? Axis::kLogarithmic : Axis::kLinear);
}

std::string eclipse(const Scenario& scenario) {
  if (!(scenario.eclipse_s[1] > scenario.eclipse_s[0])) return "";
  return format("set object 1 rectangle from first %g, graph 0 to first %g, graph 1 behind fc rgb '#dfe3ea' fs solid noborder\n",
                scenario.eclipse_s[0], scenario.eclipse_s[1]);
}

// What happened on the way, by its time: cells of the table (from, event, to, meaning).
using Events = std::multimap<double, std::vector<std::string>>;

Events events_of(const SimulationResult& result) {
  const Timeline& timeline = run_of(result).timeline;
  Events events;
  for (const TimelineChange& change : timeline.changes) {
    events.insert({change.t_s, {to_string(change.from), to_string(change.event), to_string(change.to), meaning(change)}});
  }
  for (const SensorChange& change : sensor_changes(timeline)) {
    events.insert({change.t_s,
                   {escape(result.sensors.at(change.from)), std::string("sensor: ") + to_string(change.reason),
                    escape(result.sensors.at(change.to)), format("another sensor takes the scans, at %.1f m", change.range_m)}});
  }
  return events;
}

std::vector<double> times_of(const Events& events) {
  std::vector<double> times;
  for (const auto& event : events) times.push_back(event.first);
  return times;
}

// A line at each event through the panel; the numbers above it stand in the topmost one.
std::string event_lines(const std::vector<double>& times, double end_s) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < times.size(); first = last + 1) {
    last = first;
    while (last + 1 < times.size() && times[last + 1] - times[last] < kLabelGap * end_s) ++last;
    const std::string label = first == last ? format("%zu", first + 1) : format("%zu–%zu", first + 1, last + 1);
    text += format("set label %zu '%s' at first %g, graph 1.05 center textcolor '#d4571e' font ',11'\n", first + 1, label.c_str(),
                   0.5 * (times[first] + times[last]));
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    text += format("set arrow %zu from first %g, graph 0 to first %g, graph 1 nohead lw 0.6 dt 3 lc rgb '#d4571e' front\n", i + 1, times[i],
                   times[i]);
  }
  return text;
}

std::string events_table(const Events& events) {
  HtmlTable html;
  html.head = {"", "time, s", "from", "event", "to", "meaning"};
  for (const auto& [t_s, cells] : events) {
    std::vector<std::string> row = {format("%zu", html.rows.size() + 1), format("%.1f", t_s)};
    row.insert(row.end(), cells.begin(), cells.end());
    html.rows.push_back(row);
  }
  return to_html(html);
}

std::vector<std::string> statistics_row(const std::string& name, const TimelineStatistics& run) {
  std::vector<std::string> row = {name, format("%zu", run.frames), format("%zu", run.valid)};
  if (run.valid == 0) {
    row.resize(13, "–");
    return row;
  }
  row.push_back(format("%zu", run.wrong));
  for (const double mm : {run.filtered_rms_mm, run.filtered_worst_mm}) row.push_back(format("%.2f", mm));
  for (const double deg : {run.filtered_rms_deg, run.filtered_worst_deg}) row.push_back(format("%.4f", deg));
  for (const double mm : {run.rms_mm, run.worst_mm}) row.push_back(format("%.2f", mm));
  for (const double deg : {run.rms_deg, run.worst_deg}) row.push_back(format("%.4f", deg));
  row.push_back(format("%.2f", run.nees));
  return row;
}

std::string statistics_table(const SimulationResult& result) {
  const Timeline& timeline = run_of(result).timeline;
  HtmlTable html;
  html.head = {"",      "frames",          "valid", "wrong", "filtered rms, mm", "worst", "filtered rms, deg", "worst", "single rms, mm",
               "worst", "single rms, deg", "worst", "NEES"};
  html.rows.push_back(statistics_row("all", timeline_statistics(timeline)));
  for (const auto& groups : {by_mode(timeline), by_sensor(timeline, result.sensors), by_part(timeline, result.parts)}) {
    for (const TimelineGroup& group : groups) html.rows.push_back(statistics_row(escape(plain(group.name)), group.statistics));
  }
  return to_html(html);
}

// The valid scan of one sensor and part that is farthest, or nearest; null where there is none.
const KeptScan* extreme_scan(const CaseResult& run, std::size_t sensor, std::size_t part, bool farthest) {
  const KeptScan* best = nullptr;
  for (const KeptScan& scan : run.scans) {
    const PoseTelemetry& t = scan.telemetry;
    if (t.valid == 0 || t.sensor != sensor || t.part != part) continue;
    const bool better = best == nullptr || (scan.truth.p.norm() > best->truth.p.norm()) == farthest;
    if (better) best = &scan;
  }
  return best;
}

// Of one sensor: the whole from far and from near, then each part from near; at most four.
std::vector<ScanPanel> panels_of(const SimulationResult& result, std::size_t sensor) {
  const CaseResult& run = run_of(result);
  const Vec3 center_m(result.tables.front().scenario.center_m.data());
  std::vector<ScanPanel> panels;
  const auto add = [&](const KeptScan* scan) {
    const bool there = std::any_of(panels.begin(), panels.end(), [&](const ScanPanel& panel) { return panel.scan == scan; });
    if (scan == nullptr || there || panels.size() == 4) return;
    panels.push_back({scan,
                      format("%s, %.1f m\\n%u of %u rays return", plain(result.parts.at(scan->telemetry.part)).c_str(),
                             (scan->truth * center_m).norm(), scan->telemetry.returns, scan->telemetry.plan_points),
                      center_m});
  };
  for (std::size_t part = 1; part < result.parts.size(); ++part) add(extreme_scan(run, sensor, part, false));
  if (panels.size() == 4) panels.pop_back();
  add(extreme_scan(run, sensor, 0, true));
  add(extreme_scan(run, sensor, 0, false));
  return panels;
}

std::string scan_figures(Plotter& plotter, const sim::RayCaster& target, const SimulationResult& result) {
  std::string html;
  for (std::size_t sensor = 0; sensor < result.sensors.size(); ++sensor) {
    const std::vector<ScanPanel> panels = panels_of(result, sensor);
    if (panels.empty()) continue;
    html += figure(scan_view(plotter, target, panels, false),
                   "Scans by the sensor " + escape(plain(result.sensors[sensor])) +
                       ", at the ranges of the target's centre. The model is drawn at the estimated pose. " + kScanLegend);
  }
  return html.empty() ? html : "<h2>Scans</h2>\n" + html;
}

// Panels from top to bottom, each as high as it has rows.
class Panels {
 public:
  explicit Panels(int height) : height_(height) {}
  std::string next(int height) {
    const int top = used_ + kGap;
    used_ = top + height;
    return format("set tmargin at screen %.4f\nset bmargin at screen %.4f\n", 1 - static_cast<double>(top) / height_,
                  1 - static_cast<double>(used_) / height_);
  }
  static constexpr int kGap = 34;

 private:
  int height_;
  int used_ = 0;
};

constexpr int kRow = 19, kCurve = 150, kBottom = 60;  // pixels

}  // namespace

std::string timeline_figure(Plotter& plotter, const SimulationResult& result) {
  const Timeline& timeline = run_of(result).timeline;
  const std::vector<Bars> bars = {
      {"mode", mode_names(), [](const TimelinePoint& point) { return static_cast<std::size_t>(point.mode); }},
      {"sensor", result.sensors, [](const TimelinePoint& point) { return static_cast<std::size_t>(point.sensor); }},
      {"looks at", result.parts, [](const TimelinePoint& point) { return static_cast<std::size_t>(point.part); }}};
  int height = 3 * (kCurve + Panels::kGap) + kBottom;
  for (const Bars& panel : bars) height += static_cast<int>(panel.rows.size() + 1) * kRow + Panels::kGap;
  Panels place(height);
  const std::string points = points_text(timeline), invalid = invalid_text(timeline);
  Drawing drawing(plotter);
  drawing.set(kMarksAxis);
  drawing.set("set multiplot\nset lmargin at screen 0.115\nset rmargin at screen 0.985\nset format x ''\n" + eclipse(scenario_of(result)));
  drawing.set(format("set xrange [0:%g]\nset datafile missing 'NaN'\n", end_of(timeline)) +
              event_lines(times_of(events_of(result)), end_of(timeline)));
  drawing.set("set title offset 0,-0.4\n");
  for (const Bars& panel : bars) {
    drawing.set(place.next(static_cast<int>(panel.rows.size() + 1) * kRow));
    draw_bars(drawing, timeline, panel);
    drawing.set("unset label\n");
  }
  drawing.set("set format y '%g'\n" + place.next(kCurve));
  draw_range(drawing, timeline, points);
  drawing.set("set ytics autofreq\nset yrange [*:*]\n" + place.next(kCurve));
  draw_errors(drawing, points, invalid, "error of valid poses, mm", 3);
  drawing.set(place.next(kCurve) + "set format x '%g'\nset xlabel 'time, s' textcolor '#46505f' offset 0,0.4\n");
  draw_errors(drawing, points, invalid, "error of valid poses, deg", 4);
  return drawing.svg(1080, height);
}

std::string timeline_section(Plotter& plotter, const sim::RayCaster& target, const SimulationResult& result) {
  return "<section>\n<h2>Through the modes</h2>\n" +
         figure(
             timeline_figure(plotter, result),
             "Mode, sensor in use, the part of the target that each scan looks at, the true range, and the errors of all poses that the "
             "component called valid: faint, of single scans; strong, of the filter; red, wrong; orange at the lower edge, no valid pose. "
             "Grey: the target is hidden. The numbers "
             "are those of the table of changes.") +
         "<h2>Changes of mode and sensor</h2>\n" + events_table(events_of(result)) + "<h2>Poses</h2>\n" + statistics_table(result) +
         scan_figures(plotter, target, result) + "</section>\n";
}

}  // namespace lasso::mdat
