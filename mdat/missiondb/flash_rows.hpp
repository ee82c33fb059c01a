// The keys of a flash LIDAR in [sensor] and [further_sensor.NAME]. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/toml_reader.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// Keys "sensor.flash_columns", ...
const std::vector<ValueRow>& flash_rows();

// Of the values that were found, under `found_prefix` without "sensor." behind it. Keys of a flash LIDAR in a sensor of another kind are
// problems, told with `prefix` before them.
sim::FlashModel read_flash(const FoundValues& found, const std::string& found_prefix, SensorKind kind, const std::string& prefix,
                           ProblemList& problems);

// The value of a row, as it is written.
double flash_value(const sim::FlashModel& model, const ValueRow& row);

}  // namespace lasso::mdat
