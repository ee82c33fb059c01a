#include "mdat/missiondb/settings.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

const Origin kSet{0, 0, true};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

bool is_toml_value(const std::string& text) {
  try {
    static_cast<void>(toml::parse("value = " + text));
    return true;
  } catch (const toml::parse_error&) {
    return false;
  }
}

// What is not TOML is a number (".5") or a text; JSON's quotes are TOML's, too.
std::string toml_of(const std::string& text) {
  if (is_toml_value(text)) return text;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc{} && stop == end && !text.empty()) return number_text(number);
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// A table with the one key `value`.
toml::table parsed(const std::string& text) { return toml::parse("value = " + toml_of(text), std::string_view(kSettingPlace)); }

void insert(toml::table& table, const std::string& name, const std::string& text) {
  toml::table holder = parsed(text);
  toml::node& value = *holder.get("value");
  const toml::source_region place = value.source();
  value.visit([&](auto& node) { table.insert_or_assign(toml::key(name, place), std::move(node)); });
}

// The table of a dotted path, made where it is missing; null where a value is in the way.
toml::table* table_at(toml::table& mission, const std::vector<std::string>& path) {
  toml::table* table = &mission;
  for (const std::string& name : path) {
    if (table->get(name) == nullptr) insert(*table, name, "{}");
    table = table->get(name)->as_table();
    if (table == nullptr) return nullptr;
  }
  return table;
}

// Why a key inside of a node or a further sensor cannot be set: there is none of that name. Neither has a key that must be there, so that
// a misspelt name would make another one, and nobody would hear of it. Empty: it can. `path`: of the table.
std::string missing_table(const toml::table& mission, const std::vector<std::string>& path) {
  if (path.size() < 2 || (path[0] != "node" && path[0] != "further_sensor")) return "";
  const toml::table* tables = mission.get_as<toml::table>(path[0]);
  if (tables != nullptr && tables->contains(path[1])) return "";
  std::vector<std::string> names;
  if (tables != nullptr) {
    for (const auto& [name, value] : *tables) names.emplace_back(name.str());
  }
  const std::string whole = path[0] + "." + path[1];
  return "the mission has no [" + whole + "]" + did_you_mean(path[1], names) + "; a new one is set as a whole: '" + whole + "={...}'";
}

}  // namespace

std::vector<std::string> names_of_key(const std::string& key) {
  std::vector<std::string> names;
  std::istringstream in(key);
  for (std::string name; std::getline(in, name, '.');) names.push_back(trimmed(name));
  return names;
}

Setting parts_of(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) return {};
  return {names_of_key(setting.substr(0, equals)), toml_of(trimmed(setting.substr(equals + 1)))};
}

void apply_settings(const std::vector<std::string>& settings, toml::table& mission, ProblemList& problems) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    std::vector<std::string> names = names_of_key(setting.substr(0, equals));
    if (equals == std::string::npos || names.empty()) {
      problems.add(kSet, "", setting, "expected KEY=VALUE, such as scan.points=512");
      continue;
    }
    const std::string last = names.back(), key = trimmed(setting.substr(0, equals)), value = trimmed(setting.substr(equals + 1));
    names.pop_back();
    const std::string missing = missing_table(mission, names);
    if (!missing.empty()) {
      problems.add(kSet, key, value, missing);
      continue;
    }
    toml::table* table = table_at(mission, names);
    if (table == nullptr) {
      problems.add(kSet, key, value, "unknown key; see cfg/mission.schema.json for the keys that exist");
    } else {
      insert(*table, last, value);
    }
  }
}

}  // namespace lasso::mdat
