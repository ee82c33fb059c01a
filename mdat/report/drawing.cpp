#include "mdat/report/drawing.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

// The numbers of a line; what is none ends them.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  const char* place = line.c_str();
  for (char* end = nullptr;; place = end) {
    const double number = std::strtod(place, &end);
    if (end == place) return numbers;
    numbers.push_back(number);
  }
}

bool is_shown(double y, Axis axis) { return std::isfinite(y) && (axis == Axis::kLinear || y > 0); }

}  // namespace

std::string plain(std::string text) {
  for (char& c : text) {
    if (std::string_view("_^{}@&~\\'\"`").find(c) != std::string_view::npos) c = ' ';
  }
  return text;
}

bool has_point(const std::string& rows, int y, Axis axis) {
  const auto column = static_cast<std::size_t>(y);
  std::istringstream in(rows);
  for (std::string line; std::getline(in, line);) {
    const std::vector<double> numbers = numbers_of(line);
    if (numbers.size() >= column && std::isfinite(numbers[0]) && is_shown(numbers[column - 1], axis)) return true;
  }
  return false;
}

std::string Drawing::file_of(const std::string& rows) {
  const auto [file, is_new] = files_.try_emplace(rows);
  if (is_new) file->second = plotter_.data(rows);
  return file->second;
}

void Drawing::plot(const std::vector<Curve>& curves, const std::string& why, Axis y) {
  std::string plots;
  bool drawn = false;
  for (const Curve& curve : curves) {
    if (!has_point(curve.rows, curve.y, y)) continue;
    drawn = drawn || !curve.mark;
    plots += (plots.empty() ? "plot " : ", ") + file_of(curve.rows) + format(" using 1:%d", curve.y) + curve.style;
  }
  script_ += y == Axis::kLogarithmic ? "set logscale y\n" : "unset logscale y\n";
  if (drawn) {
    has_points_ = true;
    script_ += plots + "\n";
    return;
  }
  why_ = why;  // a function below the range is a plot with nothing in it
  script_ += "set label 1000 '" + why + "' at graph 0.5,0.5 center textcolor '#46505f'\nunset ytics\nplot [][1:10] 0.1 notitle\n";
  script_ += "unset label 1000\nset ytics nomirror out scale 0.5 textcolor '#46505f'\n";
}

std::string Drawing::svg(int width, int height) const {
  if (!has_points_) return "<p class='missing'>Nothing to draw: " + escape(why_) + ".</p>";
  return plotter_.or_missing([&] { return plotter_.svg(width, height, script_ + "unset multiplot\n"); });
}

}  // namespace lasso::mdat
