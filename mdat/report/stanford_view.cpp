#include "mdat/report/stanford_view.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/common/text.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/report/page.hpp"
#include "mdat/run/integrity.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kMisleadingColour = "#c01028";
constexpr const char* kNoValue = "–";
constexpr double kSmallestErrorShare = 1.0 / 300;  // of the smallest level: what is closer is drawn there

// How many poses a point stands for, and its colour where they are within their level.
struct Shade {
  double most;
  const char *colour, *title;
};
constexpr Shade kShades[] = {{1, "#6f9fe0", "within its level"}, {10, "#2563b8", "up to 10 of them"}, {1e300, "#1b2a6b", "more of them"}};

// Both axes of a panel.
struct LevelRange {
  double low = 0, high = 0;
};

LevelRange range_of(const std::vector<LevelPoint>& points) {
  double least = 1e300, most = 0;
  for (const LevelPoint& point : points) {
    if (!(point.level > 0) || !std::isfinite(point.level)) continue;
    least = std::min(least, point.level);
    most = std::max({most, point.level, std::isfinite(point.error) ? point.error : 0});
  }
  double nearest = least;
  for (const LevelPoint& point : points) nearest = std::min(nearest, std::max(point.error, kSmallestErrorShare * least));
  return most > 0 ? LevelRange{nearest / 1.5, most * 1.5} : LevelRange{0.1, 10};
}

// Error and level of the points that stand for more than `above` and at most `most` poses.
std::string rows_of(const std::vector<LevelPoint>& points, const LevelRange& range, bool misleading, double above, double most) {
  std::string text;
  for (const LevelPoint& point : points) {
    if (point.misleading != misleading || !(point.poses > above && point.poses <= most)) continue;
    text += format("%.5g %.5g\n", std::clamp(point.error, 1.5 * range.low, range.high), std::clamp(point.level, range.low, range.high));
  }
  return text;
}

Curve dots_of(const std::string& rows, const char* colour, const char* title) {
  return {rows, 2, format(" with points pt 7 ps 0.3 lc rgb '%s' title '%s'", colour, title)};
}

void draw_levels(Drawing& drawing, const std::vector<LevelPoint>& points, const char* title) {
  const LevelRange range = range_of(points);
  drawing.set(
      format("set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nset title '%s'\n", range.low, range.high, range.low, range.high, title));
  std::vector<Curve> curves;
  double above = 0;
  for (const Shade& shade : kShades) {
    curves.push_back(dots_of(rows_of(points, range, false, above, shade.most), shade.colour, shade.title));
    above = shade.most;
  }
  curves.push_back(dots_of(rows_of(points, range, true, 0, above), kMisleadingColour, "misleading"));
  const std::string line = format("%.6g %.6g\n%.6g %.6g\n", range.low, range.low, range.high, range.high);
  curves.push_back({line, 2, " with lines lw 1.2 dt 2 lc rgb '#d4571e' title 'error = level'", true});
  drawing.plot(curves, "no valid pose", Axis::kLogarithmic);
}

// Of each kind an even selection, so that none of a few misleading ones is lost.
std::vector<LevelPoint> thinned(const std::vector<LevelPoint>& points) {
  std::vector<LevelPoint> shown;
  for (const bool misleading : {false, true}) {
    const auto is_kind = [&](const LevelPoint& point) { return point.misleading == misleading; };
    const auto count = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_kind));
    const std::size_t step = count / kStanfordPoints + 1;
    std::size_t number = 0;
    std::copy_if(points.begin(), points.end(), std::back_inserter(shown),
                 [&](const LevelPoint& point) { return is_kind(point) && number++ % step == 0; });
  }
  return shown;
}

std::string runs_table(const TableResult& table) {
  const char* run = table.scenario.drawn != 0 ? "flight" : "range";
  HtmlTable html{integrity_head(format("variant, %s", run)), {}};
  for (const VariantResult& variant : table.variants) {
    for (std::size_t i = 0; i < variant.by_range.size(); ++i)
      html.rows.push_back(integrity_row(std::string(variant.variant.title) + ", " + run_text(table.scenario, i),
                                        integrity_of(variant.by_range[i]), kNoValue));
  }
  return format("<details><summary>The same by %s</summary>", run) + to_html(html) + "</details>\n";
}

}  // namespace

const char* const kStanfordLegend =
    "Protection level over error of the valid poses (Stanford diagram). Below the line an error exceeds its level: the pose is misleading "
    "(red). An honest covariance leaves one pose in 10,000 there.";

LevelPoints level_points(const VariantResult& variant) {
  LevelPoints points;
  for (const CaseResult& run : variant.cases) {
    for (const FrameError& frame : run.frames) {
      if (!frame.valid) continue;
      points.position_mm.push_back(
          {1e3 * frame.level.position_m, 1e3 * frame.registration.translation_m.norm(), 1, frame.misleads_about_position()});
      points.attitude_deg.push_back(
          {frame.level.attitude_rad / kRadPerDeg, frame.registration.rotation_rad / kRadPerDeg, 1, frame.misleads_about_attitude()});
    }
  }
  return {thinned(points.position_mm), thinned(points.attitude_deg)};
}

std::string stanford_diagram(Plotter& plotter, const LevelPoints& points) {
  Drawing drawing(plotter);
  drawing.set("set multiplot layout 1,2 margins 0.08,0.85,0.15,0.92 spacing 0.09,0\nset logscale x\nset format '%g'\n");
  drawing.set("set xlabel 'error' textcolor '#46505f'\nset ylabel 'protection level' textcolor '#46505f'\n");
  drawing.set("set key at screen 0.998,0.92 right top vertical samplen 1.5 spacing 1.3\n");
  draw_levels(drawing, points.position_mm, "position, mm");
  drawing.set("unset key\n");
  draw_levels(drawing, points.attitude_deg, "attitude, deg");
  return drawing.svg(1080, 460);
}

std::string integrity_section(Plotter& plotter, const TableResult& table, const VariantResult& shown) {
  HtmlTable html{integrity_head("integrity"), {}};
  for (const VariantResult& variant : table.variants)
    html.rows.push_back(integrity_row(variant.variant.title, integrity_of(variant.all), kNoValue));
  return to_html(html) + "<p class='note'>" + escape(kIntegrityNote) + "</p>\n" + (shown.by_range.size() > 1 ? runs_table(table) : "") +
         figure(stanford_diagram(plotter, level_points(shown)),
                std::string(kStanfordLegend) + format(" Variant: %s. Of more than %zu poses of a kind an even selection is drawn.",
                                                      shown.variant.title, kStanfordPoints));
}

}  // namespace lasso::mdat
