// What a mission states of a sensor's laser for people's safety, in [sensor] and [further_sensor.NAME]: facts of its data sheet, from which
// nothing is computed. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/toml_reader.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// Keys "sensor.laser_class", ...
const std::vector<ValueRow>& laser_safety_rows();

// Is it one of them, of any sensor ("further_sensor.NAME.laser_class")?
bool is_laser_safety(const std::string& key);

// Of the values that were found, under `found_prefix` without "sensor." behind it. What a sensor without a laser cannot have, and a
// distance of no class, are problems, told with `prefix` before them.
LaserSafety read_laser_safety(const FoundValues& found, const std::string& found_prefix, SensorKind kind, const std::string& prefix,
                              ProblemList& problems);

// The value of a row, as it is written.
double laser_safety_value(const LaserSafety& laser, const ValueRow& row);

}  // namespace lasso::mdat
