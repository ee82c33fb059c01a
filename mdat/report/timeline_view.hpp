// The report of an approach: how the component went through its modes, and how far off its poses were on the way.
#pragma once

#include <string>

#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Modes, range and errors over time, as inline SVG.
std::string timeline_figure(Plotter& plotter, const Scenario& scenario, const Timeline& timeline);

// The section of the page: picture, figures, every change of the mode.
std::string timeline_section(Plotter& plotter, const TableResult& table);

}  // namespace lasso::mdat
