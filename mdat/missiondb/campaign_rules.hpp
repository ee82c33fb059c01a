// Campaigns against the scenarios that they fly and the rules that the values of a mission keep. Inside of missiondb.
#pragma once

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// What contradicts goes to the list, what is doubtful to the source's warnings. The rules that need no target are asked with the middle of
// all laws, and with the ends of each, one after the other: all of these are possible cases. Others are not looked at.
void check_campaigns(MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
