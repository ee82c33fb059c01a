// What the report shows of a scenario whose motion is drawn: its runs are flights of one kind, each with an attitude and axes of its own,
// and the question is how well the rates are known once the filter has settled.
#pragma once

#include <string>

#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Frames, losses and errors of the rates after kSettlingFrames of each flight: of all flights, and of each below.
std::string settled_section(const TableResult& table);

// Error of the rates against the frame, as inline SVG: a line a flight, and their root mean square.
std::string rates_figure(Plotter& plotter, const VariantResult& variant);

// Root mean square errors of each flight, as inline SVG: of its registrations, and of its rates once they have settled, if it lasts so
// long.
std::string flights_figure(Plotter& plotter, const VariantResult& variant);

}  // namespace lasso::mdat
