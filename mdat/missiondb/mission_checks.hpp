// What no single value shows: values that contradict each other, the sensor or the target, by the rules of rule.hpp. Inside of missiondb.
#pragma once

#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/rule.hpp"

namespace lasso::mdat {

// Every rule there is. A rule's number, in a Doubt, is its place here.
const Rules& all_rules();

// Asks the rules that need no target (null), or those that need one. Returns the contradictions; what is doubtful joins the source's
// doubts. Scenarios are looked at once the mission by itself has no contradiction: they would repeat it.
std::vector<Problem> check_rules(MissionSource& source, const TargetSize* target);

// Makes the initial quaternion exactly of unit length (it is checked to be within kQuaternionTolerance).
constexpr double kQuaternionTolerance = 1e-3;
void normalize_attitude(MissionParameters& parameters);

}  // namespace lasso::mdat
