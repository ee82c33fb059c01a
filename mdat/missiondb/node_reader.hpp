// [node.NAME] of a mission, and the scenes that scenarios make of them. Inside of missiondb.
#pragma once

#include <map>
#include <string>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

const std::vector<ValueRow>& node_rows();  // keys without "node.NAME."

// Reads them into the source's scene, after its motions. What is wrong is a problem.
void read_nodes(const toml::table& root, MissionSource& source, ProblemList& problems);

const std::vector<ValueRow>& relative_rows();  // keys without "relative.NAME."

// [relative.NAME], after the nodes. What is wrong is a problem.
void read_relative(const toml::table& root, MissionSource& source, ProblemList& problems);

// The motions by which a scenario replaces those that the nodes have: names by node.
using ChosenMotions = std::map<std::string, std::string>;
ChosenMotions read_chosen_motions(const toml::table& scenario, const std::string& prefix, MissionSource& source, ProblemList& problems);

// What is declared and changes nothing: motions that no node has, nodes at which nothing stands. It joins the source's warnings.
void warn_of_idle(MissionSource& source);

// Makes a scenario without ranges fly through the mission's nodes. `origin` is the scenario's place. What is wrong is a problem.
void make_scene_run(const ChosenMotions& chosen, const std::string& name, Origin origin, double period_s, const MissionSource& source,
                    Scenario& scenario, ProblemList& problems);

}  // namespace lasso::mdat
