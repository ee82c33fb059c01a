#include "mdat/report/scan_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "mdat/common/text.hpp"
#include "mdat/report/base64.hpp"

namespace lasso::mdat {
namespace {

constexpr int kLeftMargin = 88, kRightMargin = 132, kAxisWidth = 48, kTitleLine = 26, kTitleGap = 14, kAxisHeight = 58;  // pixels
constexpr int kPicture = 1002, kNarrowest = 300, kLowest = 200, kHighest = 430;  // of all panels side by side; of one
constexpr double kPanelArea = 430.0 * 334.0;
constexpr int kSamplesPerAxis = 3;  // rays of a pixel
constexpr double kFrameMargin = 1.12;
constexpr double kLeastShape = 0.4;  // of a panel: narrower views have room at their sides
using Colour = std::array<double, 3>;
constexpr Colour kBackground = {255, 255, 255}, kDark = {72, 84, 104}, kBright = {226, 231, 238};

// What a panel shows: a rectangle of the tangent plane with square pixels.
struct View {
  double x, y, half_x, half_y;  // tangent plane
  int width, height;            // pixels
};

// Equal panels from left to right, then downwards, as wide and high as what they show; the colour scale stands at the right of all.
struct Layout {
  int panel_width = 0, panel_height = 0, title_height = 0, columns = 1, rows = 1;
  bool one_size = true;  // panels beside each other share the axis at the left

  int pitch() const { return panel_width + (one_size ? 0 : kAxisWidth); }
  int row_height() const { return title_height + panel_height + kAxisHeight; }
  int width() const { return kLeftMargin + columns * pitch() + kRightMargin; }
  int height() const { return rows * row_height(); }
};

// `shape` is width over height of what a panel shows.
Layout layout_of(double shape, std::size_t count, bool one_size) {
  Layout layout;
  const double width = std::clamp(std::sqrt(kPanelArea * shape), double{kNarrowest}, double{kPicture});
  layout.panel_width = static_cast<int>(width);
  layout.panel_height = std::clamp(static_cast<int>(width / shape), kLowest, kHighest);
  layout.one_size = one_size;
  layout.columns = std::clamp(kPicture / layout.pitch(), 1, static_cast<int>(count));
  layout.rows = (static_cast<int>(count) + layout.columns - 1) / layout.columns;
  return layout;
}

// A rectangle about the scan's middle, a pixel of it for each of the panel.
View make_view(const PoseTelemetry& telemetry, double half_x, double half_y, const Layout& layout) {
  View view{telemetry.plan_center[0], telemetry.plan_center[1], half_x, half_y, 0, 0};
  view.width = layout.panel_width;
  view.height = std::max(1, static_cast<int>(std::lround(view.width * half_y / half_x)));
  return view;
}

Vec3 direction_of(const View& view, double column, double row) {
  const double x = view.x + view.half_x * (2 * column / view.width - 1);
  const double y = view.y + view.half_y * (2 * row / view.height - 1);
  return Vec3(x, y, 1).normalized();
}

Colour shade(const sim::RayCaster& target, const Pose& T_target_sensor, const Vec3& direction) {
  const Vec3 u = rotate(T_target_sensor.q, direction);
  const sim::RayHit hit = target.cast(T_target_sensor.p, u);
  if (!hit.hit) return kBackground;
  const double light = std::fabs(hit.normal.dot(u));
  Colour colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = kDark[i] + (kBright[i] - kDark[i]) * light;
  return colour;
}

Colour pixel(const sim::RayCaster& target, const Pose& T_target_sensor, const View& view, int column, int row) {
  Colour sum{};
  for (int i = 0; i < kSamplesPerAxis * kSamplesPerAxis; ++i) {
    const double x = column + (i % kSamplesPerAxis + 0.5) / kSamplesPerAxis;
    const int down = i / kSamplesPerAxis;
    const double y = row + (down + 0.5) / kSamplesPerAxis;
    const Colour colour = shade(target, T_target_sensor, direction_of(view, x, y));
    for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c] / (kSamplesPerAxis * kSamplesPerAxis);
  }
  return sum;
}

// Red, green and blue bytes, row by row from the top.
std::string render(const sim::RayCaster& target, const Pose& T_sensor_target, const View& view) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  std::string bytes;
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      for (const double value : pixel(target, T_target_sensor, view, column, row)) bytes += static_cast<char>(std::lround(value));
    }
  }
  return bytes;
}

Vec3 direction_of(const RangeSample& sample) {
  return {static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]), static_cast<double>(sample.direction[2])};
}

// Aimed rays are in the middle of their scan.
bool is_aimed(const KeptScan& scan, std::size_t index) {
  const std::size_t first = (scan.samples.size() - scan.aimed) / 2;
  return index >= first && index < first + scan.aimed;
}

std::string aimed_text(const KeptScan& scan) {
  std::string text;
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const Vec3 u = direction_of(scan.samples[i]);
    if (is_aimed(scan, i)) text += format("%.5f %.5f\n", u.x() / u.z(), u.y() / u.z());
  }
  return text;
}

// Rays of the pattern that met something, or nothing, where the model, at this pose, is, or is not. With them measured minus predicted
// range, mm; of those that lack one of both 0.
std::string points_text(const KeptScan& scan, RayState state, bool on_model, const sim::RayCaster& target, const Pose& pose) {
  std::string text;
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const RangeSample& sample = scan.samples[i];
    if (is_aimed(scan, i) || sample.state != state) continue;
    const Vec3 u = direction_of(sample);
    const double residual = residual_m(target, pose, sample);
    if (std::isnan(residual) == on_model) continue;
    text += format("%.5f %.5f %.4f\n", u.x() / u.z(), u.y() / u.z(), on_model && state == RayState::kHit ? 1e3 * residual : 0);
  }
  return text;
}

// The largest residual that is not exceptional, so that the colours show the bulk.
double residual_span_mm(const sim::RayCaster& target, const std::vector<ScanPanel>& panels) {
  std::vector<double> sizes;
  for (const ScanPanel& panel : panels) {
    for (const RangeSample& sample : panel.scan->samples) {
      const double residual = sample.state == RayState::kHit ? residual_m(target, registration_pose(panel.scan->telemetry), sample) : 0;
      if (sample.state == RayState::kHit && !std::isnan(residual)) sizes.push_back(1e3 * std::fabs(residual));
    }
  }
  if (sizes.empty()) return 1;
  std::sort(sizes.begin(), sizes.end());
  return std::max(1e-3, sizes[sizes.size() * 97 / 100]);
}

// About three tics to a span: 1, 2 or 4 times a power of ten.
double tic_step(double span_m) {
  const double base = std::pow(10, std::floor(std::log10(span_m / 2.5)));
  const double times = span_m / 2.5 / base;
  return base * (times < 2 ? 1 : times < 4 ? 2 : 4);
}

std::string draw(Plotter& plotter, const sim::RayCaster& target, const ScanPanel& panel, const View& view) {
  const KeptScan& scan = *panel.scan;
  const Pose pose = registration_pose(scan.telemetry);
  const std::string image = plotter.data(render(target, pose, view));
  const auto points = [&](RayState state, bool on_model) { return plotter.data(points_text(scan, state, on_model, target, pose) + "\n"); };
  const std::string misses = points(RayState::kMiss, false);
  const std::string hits = points(RayState::kHit, true);
  const std::string holes = points(RayState::kMiss, true);
  const std::string strays = points(RayState::kHit, false);
  const double z_m = (pose * panel.center_m).z();
  const std::string aimed = plotter.data(aimed_text(scan) + "\n");
  std::string text = "set title \"" + panel.title + "\"\n";
  const double step_m = tic_step(2 * z_m * view.half_x);
  text += format("set xtics %g\nset ytics %g\n", step_m, step_m);
  text += format("set xrange [%.4f:%.4f]\nset yrange [%.4f:%.4f]\n", z_m * (view.x - view.half_x), z_m * (view.x + view.half_x),
                 z_m * (view.y + view.half_y), z_m * (view.y - view.half_y));
  const double dx = 2 * view.half_x * z_m / view.width, dy = 2 * view.half_y * z_m / view.height;
  text += format("plot %s binary array=(%d,%d) format='%%uchar' dx=%.7f dy=%.7f origin=(%.5f,%.5f) with rgbimage notitle, ", image.c_str(),
                 view.width, view.height, dx, dy, z_m * (view.x - view.half_x) + dx / 2, z_m * (view.y - view.half_y) + dy / 2);
  text += format("%s using ($1*%.5f):($2*%.5f) with points pt 7 ps 0.3 lc rgb '#b6bec9' notitle, ", misses.c_str(), z_m, z_m);
  text += format("%s using ($1*%.5f):($2*%.5f):3 with points pt 7 ps 0.5 lc palette notitle, ", hits.c_str(), z_m, z_m);
  text += format("%s using ($1*%.5f):($2*%.5f) with points pt 6 ps 0.6 lc rgb '#101418' notitle, ", holes.c_str(), z_m, z_m);
  text += format("%s using ($1*%.5f):($2*%.5f) with points pt 2 ps 0.6 lc rgb '#101418' notitle, ", strays.c_str(), z_m, z_m);
  return text + format("%s using ($1*%.5f):($2*%.5f) with points pt 7 ps 0.3 lc rgb '#7a2fb5' notitle\n", aimed.c_str(), z_m, z_m);
}

constexpr const char* kScanStyle =
    "set size ratio -1\nset border 0\nset tics nomirror out scale 0.4 textcolor '#46505f' font ',12'\nset title textcolor '#2b3440' offset "
    "0,-0.6\n"
    "set xlabel 'right, m' textcolor '#46505f' font ',12' offset 0,0.4\n"
    "set palette defined (-1 '#1257b0', -0.5 '#49a0e8', 0 '#f2d43d', 0.5 '#ef7d2b', 1 '#b3102a')\n"
    "set cblabel 'measured minus predicted range, mm' textcolor '#46505f' font ',12'\nset cbtics scale 0\n";

std::string place(std::size_t i, std::size_t count, const Layout& layout) {
  const double x = 1.0 / layout.width(), y = 1.0 / layout.height();
  const int column = static_cast<int>(i) % layout.columns, row = static_cast<int>(i) / layout.columns;
  const double left = x * (kLeftMargin + layout.pitch() * column);
  const double top = 1 - y * (row * layout.row_height() + layout.title_height);
  std::string text = format("set lmargin at screen %.4f\nset rmargin at screen %.4f\n", left, left + x * layout.panel_width);
  text += format("set tmargin at screen %.4f\nset bmargin at screen %.4f\n", top, top - y * layout.panel_height);
  text += column == 0 ? "set ylabel 'down, m' textcolor '#46505f' font ',12' offset 1\n" : "unset ylabel\n";
  text += layout.one_size && column > 0 ? "set format y ''\n" : "set format y '%g'\n";
  if (i + 1 < count) return text + "unset colorbox\n";
  // Beside the first row.
  return text + format("set colorbox user origin screen %.4f,%.4f size screen %.4f,%.4f\n", 1 - 102 * x,
                       1 - y * (layout.title_height + layout.panel_height), 14 * x, y * layout.panel_height);
}

// Half a rectangle of the tangent plane that has all of a scan in it.
std::pair<double, double> half_extents(const KeptScan& scan) {
  return {std::max(1e-3, kFrameMargin * scan.telemetry.plan_half_extents[0]),
          std::max(1e-3, kFrameMargin * scan.telemetry.plan_half_extents[1])};
}

}  // namespace

double residual_m(const sim::RayCaster& target, const Pose& T_sensor_target, const RangeSample& sample) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  const sim::RayHit hit = target.cast(T_target_sensor.p, rotate(T_target_sensor.q, direction_of(sample)));
  return hit.hit ? static_cast<double>(sample.range_m) - hit.range_m : std::numeric_limits<double>::quiet_NaN();
}

std::string scan_view_png(Plotter& plotter, const sim::RayCaster& target, const std::vector<ScanPanel>& panels, bool one_size,
                          double scale) {
  const double span_mm = residual_span_mm(target, panels);
  double widest = 0, highest = 0, shape = 0;
  for (const ScanPanel& panel : panels) {
    const auto [half_x, half_y] = half_extents(*panel.scan);
    widest = std::max(widest, half_x);
    highest = std::max(highest, half_y);
    shape = std::max(shape, half_x / half_y);
  }
  if (one_size) shape = widest / highest;
  shape = std::clamp(shape, kLeastShape, 1 / kLeastShape);
  Layout layout = layout_of(shape, panels.size(), one_size);
  const bool two_lines =
      std::any_of(panels.begin(), panels.end(), [](const ScanPanel& panel) { return panel.title.find("\\n") != std::string::npos; });
  layout.title_height = kTitleGap + (two_lines ? 2 : 1) * kTitleLine;
  std::string script = kScanStyle + format("set cbrange [%g:%g]\nset multiplot\n", -span_mm, span_mm);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto [own_x, own_y] = half_extents(*panels[i].scan);
    const double half_x = one_size ? std::max(widest, highest * shape) : std::max(own_x, own_y * shape);
    const View view = make_view(panels[i].scan->telemetry, half_x, half_x / shape, layout);
    script += place(i, panels.size(), layout) + draw(plotter, target, panels[i], view);
  }
  return plotter.png(layout.width(), layout.height(), scale, script + "unset multiplot\n");
}

std::string scan_view(Plotter& plotter, const sim::RayCaster& target, const std::vector<ScanPanel>& panels, bool one_size) {
  return plotter.or_missing([&] {
    return "<img alt='scans on the target' src='data:image/png;base64," + base64(scan_view_png(plotter, target, panels, one_size, 1)) +
           "'>";
  });
}

}  // namespace lasso::mdat
