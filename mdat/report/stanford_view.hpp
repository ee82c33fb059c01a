// The Stanford diagram of integrity monitoring: what poses say of their error against what it is.
#pragma once

#include <string>
#include <vector>

#include "mdat/report/plotter.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

struct LevelPoint {
  double level = 0, error = 0;
  double poses = 1;  // that it stands for: its shade says it
  bool misleading = false;
};
struct LevelPoints {
  std::vector<LevelPoint> position_mm, attitude_deg;
};

// Points of one kind that a diagram of a run has at most: evenly chosen among all.
constexpr std::size_t kStanfordPoints = 1500;

// Of the valid poses of all runs of a variant.
LevelPoints level_points(const VariantResult& variant);

// Protection level over error, both logarithmic, position beside attitude, as inline SVG. Misleading poses lie below the line and are red.
std::string stanford_diagram(Plotter& plotter, const LevelPoints& points);

// What it shows, for its caption.
extern const char* const kStanfordLegend;

// Times to alert and protection levels of the table's variants and of each run, and the diagram of `shown`.
std::string integrity_section(Plotter& plotter, const TableResult& table, const VariantResult& shown);

}  // namespace lasso::mdat
