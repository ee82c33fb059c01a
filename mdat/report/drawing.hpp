// A figure of curves: what has no point is left out here, for all figures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

// What all figures look like.
constexpr const char* kPlotStyle =
    "set border 3 lc rgb '#8a94a3'\nset tics nomirror out scale 0.5 textcolor '#46505f'\nset grid lc rgb '#e3e7ed' lt 1 lw 0.7\n"
    "set key textcolor '#2b3440'\nset title textcolor '#2b3440'\n";

struct Curve {
  std::string rows;   // numbers, a line each; of NaN there is no point, and a line without numbers is a gap
  int y = 2;          // its column, from 1; x is the first
  std::string style;  // for gnuplot, behind `using 1:y`: more columns, and how they are drawn
  bool mark = false;  // drawn beside other curves only: of marks alone there is no plot
};

enum class Axis { kLinear, kLogarithmic };

class Drawing {
 public:
  explicit Drawing(Plotter& plotter) : plotter_(plotter), script_(kPlotStyle) {}

  // gnuplot's settings, each with its line's end.
  void set(const std::string& settings) { script_ += settings; }

  // The next plot, or the next panel. Curves without a point that its y axis can show are left out; where all are, `why` stands there.
  void plot(const std::vector<Curve>& curves, const std::string& why, Axis y = Axis::kLinear);

  // The figure for a page, an inline SVG element; a line that says why, where no plot has a point, or gnuplot fails (Plotter::or_missing).
  std::string svg(int width, int height) const;

 private:
  std::string file_of(const std::string& rows);

  Plotter& plotter_;
  std::string script_, why_;
  std::map<std::string, std::string> files_;  // rows, and the file that they are in
  bool has_points_ = false;
};

// Text without what gnuplot reads as more than text.
std::string plain(std::string text);

// Is there a row with a number in its first column and one in column y that the axis can show?
bool has_point(const std::string& rows, int y, Axis axis);

}  // namespace lasso::mdat
