// The report of a run: one HTML file that needs nothing else, with figures by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "mdat/report/plotter.hpp"
#include "mdat/report/scene_view.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// A figure that cannot be drawn is a line in it that says why, and the plotter's missing().
std::string report_html(Plotter& plotter, const CompiledMission& mission, const SimulationResult& result,
                        const std::vector<SeenPicture>& pictures = {});

// The scan on the target, as one PNG picture (for the README). Throws PictureError.
std::string picture_png(Plotter& plotter, const CompiledMission& mission, const SimulationResult& result);

}  // namespace lasso::mdat
