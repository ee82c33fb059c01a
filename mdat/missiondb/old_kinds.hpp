// Scenarios once had kinds. What a person writes instead of one. Inside of missiondb.
#pragma once

#include <string>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// Where the scenario's table has the key `kind`: a problem at that line, with the lines that say the same today, and those that have to go.
// `prefix` is the scenario's path with a dot at its end.
void refuse_kind(const toml::table& scenario, const std::string& prefix, ProblemList& problems);

}  // namespace lasso::mdat
