// [orbit] and [motion.NAME] of a mission. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

// What a kind of motion is told by.
struct MotionKind {
  std::string name, meaning;
  std::vector<ValueRow> rows;       // without `kind`
  std::string list;                 // key of an array of tables beside them; empty: none
  std::vector<ValueRow> list_rows;  // of each of these
  bool needs_orbit = false;
};
const std::vector<MotionKind>& motion_kinds();
const std::vector<ValueRow>& orbit_rows();  // keys from [orbit]

// Reads them into the source's scene; files that motions name are the source's. What is wrong is a problem.
void read_motions(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
