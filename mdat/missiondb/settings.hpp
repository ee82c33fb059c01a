// Values that stand in place of a mission file's: KEY=VALUE of the command line. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// The names of a dotted key, without the spaces about them.
std::vector<std::string> names_of_key(const std::string& key);

// KEY=VALUE taken apart, VALUE as TOML writes it. Without KEY or "=" there are no names.
struct Setting {
  std::vector<std::string> names;
  std::string toml;
};
Setting parts_of(const std::string& setting);

// Writes each setting into the mission as if its file said so; the later of two holds. VALUE is TOML, or a text without its quotes. What is
// no setting is a problem; keys and values are checked where those of the file are.
void apply_settings(const std::vector<std::string>& settings, toml::table& mission, ProblemList& problems);

}  // namespace lasso::mdat
