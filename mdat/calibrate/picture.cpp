#include "mdat/calibrate/picture.hpp"

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/text.hpp"
#include "mdat/report/drawing.hpp"

namespace lasso::mdat {
namespace {

constexpr int kWidth = 1800, kHeight = 560;
constexpr const char* kLayout =
    "set multiplot layout 1,3\nset logscale y\nset xlabel 'mirror x, deg'\nset ylabel 'depth, m'\nset xtics 5\n"
    "set style textbox noborder\n"
    "set palette defined (0 '#e9f2fb', 1 '#9cc9e8', 2 '#f0b27a', 3 '#e08a7d')\n";

// Angle in degrees, depth, value; a cell without points is left empty.
std::string cells_text(const CalibrationReport& report, double ResidualCell::*value) {
  std::string text;
  for (const ResidualCell& cell : report.cells) {
    if (cell.points > 0) text += format("%.4g %.4g %.4g\n", cell.angle_x_rad / kRadPerDeg, cell.depth_m, cell.*value);
  }
  return text;
}

// The middles of the outermost cells of both, and half a cell more, so that all panels show the same volume.
std::string axes(const CalibrationReport& a, const CalibrationReport& b) {
  const double widest_deg = 1.2 * std::max(a.cells.back().angle_x_rad, b.cells.back().angle_x_rad) / kRadPerDeg;
  const double nearest_m = std::min(a.cells.front().depth_m, b.cells.front().depth_m) / 1.2;
  const double farthest_m = std::max(a.cells.back().depth_m, b.cells.back().depth_m) * 1.2;
  return format("set xrange [%g:%g]\nset yrange [%g:%g]\nset ytics (1, 2, 3, 5, 7, 10, 20, 50)\n", -widest_deg, widest_deg, nearest_m,
                farthest_m);
}

std::string panel(const std::string& title, const std::string& data, const char* range) {
  return format("set title '%s'\nset cbrange %s\nplot %s using 1:2:3 with points pt 5 ps 6 palette notitle, ", title.c_str(), range,
                data.c_str()) +
         format("%s using 1:2:(sprintf($3 < 10 ? '%%.2f' : '%%.0f', $3)) with labels font ',9' textcolor '#2b3440' notitle\n",
                data.c_str());
}

}  // namespace

std::string residual_picture(Plotter& plotter, const CalibrationReport& before, const CalibrationReport& after) {
  const std::string rms_before = plotter.data(cells_text(before, &ResidualCell::rms_over_noise));
  const std::string rms = plotter.data(cells_text(after, &ResidualCell::rms_over_noise));
  const std::string mean = plotter.data(cells_text(after, &ResidualCell::mean_over_noise));
  std::string script = kPlotStyle;
  script += kLayout;
  script += axes(before, after);
  script += panel("before: rms over noise", rms_before, "[0:10]");
  script += panel("after: rms over noise", rms, "[0:2]");
  script += panel("after: mean over noise", mean, "[-0.5:0.5]");
  script += "unset multiplot\n";
  return plotter.png(kWidth, kHeight, 1, script);
}

}  // namespace lasso::mdat
