// The figures of the report as inline SVG.
#pragma once

#include <string>

#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// In at least one frame: there is something to draw.
bool is_tracked(const VariantResult& variant);

// Error of each axis against the target's angle, a line a range (the paper's figure 11).
std::string error_against_angle(Plotter& plotter, const TableResult& table, const VariantResult& variant);

// Error against range, all variants and the bound (the paper's figure 13).
std::string error_against_range(Plotter& plotter, const TableResult& table);

// How the times of the estimates are distributed.
std::string time_histogram(Plotter& plotter, const TableResult& table);

}  // namespace lasso::mdat
