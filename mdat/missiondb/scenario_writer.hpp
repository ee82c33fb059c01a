// The scenarios of a new mission, scaled to target and sensor. Inside of missiondb.
#pragma once

#include <ostream>
#include <vector>

#include "mdat/missiondb/mesh_facts.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// Two significant digits: a person will read and change it.
double rounded(double value);

std::vector<double> list_of(const Eigen::Vector3d& v);

// "key = value  # [unit] meaning; range".
void write_row(std::ostream& out, const ValueRow& row, const std::vector<double>& value);

// paper, spin, search and approach; none switches off what protects a track.
void write_scenarios(std::ostream& out, const MeshSize& size, double range_m);

}  // namespace lasso::mdat
