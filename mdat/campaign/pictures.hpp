// Pictures of what goes with bad cases, as inline SVG. Of very many cases some are drawn: all say so.
#pragma once

#include <string>
#include <vector>

#include "mdat/campaign/findings.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

// Points of one kind that a picture has at most: evenly chosen by number among all.
constexpr std::size_t kShownPoints = 1000;

bool has_pair(const ResultTable& table, const Finding& finding);

// How a criterion's figure is distributed over all cases, with its bounds; beside it all cases over the two columns that matter most and
// are no parts of one vector, where has_pair().
std::string distribution_picture(Plotter& plotter, const ResultTable& table, const Finding& finding);

// The figure over each of the (at most three) columns that matter most, and below the share of cases outside in parts of the column's
// range. At least one column varies.
std::string columns_picture(Plotter& plotter, const ResultTable& table, const Finding& finding);

// Cases that lie next to each other in a column: their range there, and how many of them are outside.
struct Bin {
  double low = 0, high = 0, mean = 0;
  std::size_t cases = 0, outside = 0;
};

// Of about equally many cases each, at least 10, at most 8 bins; equal values are in one bin.
std::vector<Bin> bins_of(const ResultTable& table, const Finding& finding, std::size_t column);

}  // namespace lasso::mdat
