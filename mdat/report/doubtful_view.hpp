// The frames of a run that are wrong, or without a valid pose: which they are, why, and the scans of the first of them.
#pragma once

#include <string>

#include "hal_sim/ray_caster.hpp"
#include "mdat/report/drawing.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Of a table, a line for frames in a row that have the same trouble for the same reason, and pictures of scans; empty where there are none.
std::string doubtful_section(Plotter& plotter, const sim::RayCaster& target, const TableResult& table);

// Marks at the upper edge of a plot, red where frames are wrong, and at the lower one, orange where they have no valid pose.
// `abscissa_step` is what a frame is on the x axis. The plot needs kMarksAxis.
std::vector<Curve> doubtful_marks(const VariantResult& variant, double abscissa_step);
constexpr const char* kMarksAxis = "set y2range [0:1]\n";

}  // namespace lasso::mdat
