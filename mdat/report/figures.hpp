// The figures of the report as inline SVG.
#pragma once

#include <string>

#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Of the curves of the i-th range, the nearest first.
const char* range_colour(std::size_t i);

// Frames of the longest run: one without a prior begins with its first valid pose.
std::size_t longest_run(const VariantResult& variant);

// The hits have a bound, at some range: only those of a target that stands still in the scan.
bool has_bound(const TableResult& table);

// Does the target turn by a step a frame, so that errors are shown against its angle? Against the frame where it does not.
bool turns_by_steps(const TableResult& table);

// Error of each axis against the target's angle or the frame, a line a range (the paper's figure 11).
std::string error_against_angle(Plotter& plotter, const TableResult& table, const VariantResult& variant);

// Error against range, all variants and the bound where there is one (the paper's figure 13).
std::string error_against_range(Plotter& plotter, const TableResult& table);

// How the times of the estimates are distributed.
std::string time_histogram(Plotter& plotter, const TableResult& table);

}  // namespace lasso::mdat
