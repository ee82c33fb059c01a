// What a key of a mission means, and what may stand there: read from the schema of missions, which is made from the loader's rows.
#pragma once

#include <string>
#include <vector>

namespace lasso::mdat {

// A key that can be written, or a table of keys. NAME stands for a name that the mission chooses: node.NAME.position_m.
struct KeyFacts {
  std::string key;  // dotted, from the mission's root
  bool table = false;
  std::string meaning, unit;
  std::string expected;  // "a whole number from 64 to 4096"; empty for a table
  std::string preset;    // as TOML; empty: there is none
};

// Of the key itself, in each of the forms that it may have: a motion has some keys for one kind alone. Chosen names may stand where they
// are chosen. None: there is no such key.
std::vector<KeyFacts> facts_of(const std::string& key);

// Of what stands directly in this table; "" is the mission. Each key once.
std::vector<KeyFacts> keys_in(const std::string& table);

// Every key of a mission that holds a value.
std::vector<std::string> all_keys();

// The other keys that `mdat mission check` looks at together with this one, each once.
std::vector<std::string> checked_with(const std::string& key);

}  // namespace lasso::mdat
