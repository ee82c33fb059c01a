// What no single value shows: values that contradict each other. Inside of missiondb.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// Called per contradiction with the keys that take part (the first is the one to change), their values as text, and what was expected.
using Complaint = std::function<void(const std::vector<std::string>& keys, const std::string& value, const std::string& expected)>;

void check_parameters(const MissionParameters& parameters, const Complaint& complain);

// Of a further sensor; the keys are without "further_sensor.NAME.".
void check_sensor(const SensorParameters& sensor, const Complaint& complain);

// What each sensor measures in the scenario, [sensor] first: from, to. The keys are without "scenario.NAME.".
using MeasuredRanges = std::vector<std::pair<double, double>>;
void check_scenario(const Scenario& scenario, const MeasuredRanges& measured, const Complaint& complain);

// Makes the initial quaternion exactly of unit length (it is checked to be within kQuaternionTolerance).
constexpr double kQuaternionTolerance = 1e-3;
void normalize_attitude(MissionParameters& parameters);

}  // namespace lasso::mdat
