// [sensor.detector] and [further_sensor.NAME.detector] of a mission: the light that the simulated sensor gets back. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "hal_sim/detector.hpp"
#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

struct DetectorField {
  ValueRow row;                                  // key without "sensor."
  double sim::DetectorModel::*member = nullptr;  // none: which return is told
};
const std::vector<DetectorField>& detector_fields();

// In SI.
double detector_value(const sim::DetectorModel& model, const DetectorField& field);

// What was found under these keys with `prefix` before them, and else the presets. Values that contradict each other are problems of the
// table `owner`, such as "sensor.".
sim::DetectorModel read_detector(const FoundValues& found, const std::string& prefix, const std::string& owner, ProblemList& problems);

// Warns of sensors whose detectors would see sunlight in a mission without [orbit].
void warn_of_no_sun(MissionSource& source);

}  // namespace lasso::mdat
