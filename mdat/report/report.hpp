// The report of a run: one HTML file that needs nothing else, with figures by gnuplot.
#pragma once

#include <string>

#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Throws RunError naming the package where gnuplot is missing.
void require_plotter();

// Throws RunError where gnuplot fails.
std::string report_html(const CompiledMission& mission, const SimulationResult& result);

// The scan on the target, as one PNG picture (for the README).
std::string picture_png(const CompiledMission& mission, const SimulationResult& result);

}  // namespace lasso::mdat
