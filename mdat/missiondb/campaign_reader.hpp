// Campaigns, [campaign.NAME], from a mission's file. Inside of missiondb.
#pragma once

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// Fills source.campaigns, and the origins of their keys, from the mission's whole table. What is wrong goes to the list.
void read_campaigns(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
