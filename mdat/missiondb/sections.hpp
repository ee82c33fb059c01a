// The ground sections of a mission ([mission], [target], the kind of sensor, [scenario.NAME]) as rows, with the members that they fill.
// Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

// Keys "mission.id", "target.scale", ... `target.parameters` is a table of numbers beside them.
const std::vector<ValueRow>& mission_rows();

// What holds where nobody wrote `key` (a flight parameter's, or of a scenario's field): `preset`, unless the kind of sensor has its own.
double preset_of(SensorKind sensor, const std::string& key, double preset);

// A part of the target, [part.NAME].
struct PartField {
  ValueRow row;                          // key without "part.NAME."
  double PartSource::*number = nullptr;  // one of the two, or none for a text
  std::vector<double> PartSource::*list = nullptr;
};
const std::vector<PartField>& part_fields();
const std::vector<ValueRow>& part_rows();

struct ScenarioField {
  ValueRow row;                        // key without "scenario.NAME."
  double Scenario::*number = nullptr;  // one of the two
  std::vector<double> Scenario::*list = nullptr;
};

// `override` is a table of flight parameters beside them.
const std::vector<ScenarioField>& scenario_fields();
const std::vector<ValueRow>& scenario_rows();

}  // namespace lasso::mdat
