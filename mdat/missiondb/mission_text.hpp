// What `mdat mission check` and `mdat mission info` print.
#pragma once

#include <string>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// One line of what was found good, after the warnings. Loads the target; throws MissionError where that fails.
std::string check_text(const MissionSource& source, const Mesh& mesh);

// Every effective value with its unit, its meaning and where it came from (file:line or preset); scenario "" shows the mission's own.
std::string info_text(const MissionSource& source, const std::string& scenario = "");

// A value that holds, in the unit that its key names, and where it came from.
struct EffectiveValue {
  std::string key, value, unit, place, meaning;  // no key: an empty line between two sections
};
// Of the target, the sensors, the parameters as they hold in the scenario (empty: the mission's own), the parts and the scenario (all).
std::vector<EffectiveValue> effective_values(const MissionSource& source, const std::string& scenario = "");

// The settings of the command line without which their value would be the same, as the mission says it or another setting does.
std::vector<std::string> idle_settings(const MissionSource& source, const std::string& scenario);

// The values that are not their presets, or have none; and all that is stated of lasers: no inhibit differs from nothing stated.
struct Deviation {
  EffectiveValue value;
  std::string preset;  // empty: there is none
};
std::vector<Deviation> deviations(const MissionSource& source, const std::string& scenario);

}  // namespace lasso::mdat
