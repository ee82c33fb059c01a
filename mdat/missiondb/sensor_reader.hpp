// The sensors besides [sensor], [further_sensor.NAME], from a mission's file. Inside of missiondb.
#pragma once

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// Keys as in [sensor]: its kind, the values of sensor_rows(), and the file of its calibration; then detector and pixels; its node is last.
const std::vector<ValueRow>& further_sensor_rows();

// Fills source.further_sensors, and the origins of their keys, from the mission's whole table, after its nodes. What is wrong goes to the
// list; of a sensor's node: one that is not there, that moves against the sensor frame, or looks elsewhere than that.
void read_further_sensors(const toml::table& root, MissionSource& source, ProblemList& problems);

// Fills source.calibrations from the files that the sensors name. Throws MissionError where one of them is not right.
void read_calibrations(MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
