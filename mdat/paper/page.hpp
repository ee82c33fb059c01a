// The page of the paper's experiments: one HTML file that needs nothing else, with figures by gnuplot.
#pragma once

#include <string>

#include "mdat/paper/experiments.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

// A figure that cannot be drawn is a line in it that says why, and the plotter's missing().
std::string paper_html(Plotter& plotter, const PaperResult& result);

}  // namespace lasso::mdat
