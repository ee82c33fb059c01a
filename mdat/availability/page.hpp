// The page of a comparison: one HTML file that needs nothing else, with figures by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "mdat/availability/figures.hpp"
#include "mdat/report/plotter.hpp"
#include "mdat/report/scene_view.hpp"

namespace lasso::mdat {

// A figure that cannot be drawn is a line in it that says why, and the plotter's missing().
std::string comparison_html(Plotter& plotter, const HeadComparison& comparison, const std::vector<SeenPicture>& pictures);

}  // namespace lasso::mdat
