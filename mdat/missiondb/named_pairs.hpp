// What a flight image says of [relative.NAME]: the pairs of frames that the component tells poses of.
#pragma once

#include <string>
#include <vector>

#include "fsw/mission/named_frame.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

struct NamedPair {
  std::string name;
  NamedFrame frame;
};

// By name. Those with `telemetry` whose axes stand still against the sensors: how others turn, the component does not know. None where a
// mission says no target or no sensor of its scene.
std::vector<NamedPair> named_pairs(const SceneSource& scene);

// More pairs than an image has room for; and `telemetry = true` of axes that turn.
void check_named_pairs(const MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
