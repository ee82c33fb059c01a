// The report of an approach, or a pass: how the component went through its modes, and how far off its poses were on the way.
#pragma once

#include <string>

#include "hal_sim/ray_caster.hpp"
#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Modes, sensors, parts, range and errors over time, as inline SVG.
std::string timeline_figure(Plotter& plotter, const SimulationResult& result);

// The section of the page: picture, figures, every change of mode and sensor, and a few scans.
std::string timeline_section(Plotter& plotter, const sim::RayCaster& target, const SimulationResult& result);

}  // namespace lasso::mdat
