#include "mdat/missiondb/mission_diff.hpp"

#include <map>

#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

std::map<std::string, EffectiveValue> by_key(const std::vector<EffectiveValue>& values) {
  std::map<std::string, EffectiveValue> result;
  for (const EffectiveValue& value : values) result[value.key] = value;
  return result;
}

// Nobody wrote it: another key's value holds.
bool follows(const EffectiveValue& value) { return value.place.rfind("as ", 0) == 0; }

}  // namespace

std::vector<ValueChange> changes_between(const std::vector<EffectiveValue>& first, const std::vector<EffectiveValue>& second) {
  std::vector<ValueChange> changes;
  const auto before = by_key(first), after = by_key(second);
  for (const EffectiveValue& value : first) {
    const auto other = after.find(value.key);
    const std::string now = other == after.end() ? "" : other->second.value;
    const bool follow = other != after.end() && follows(value) && follows(other->second);
    if (!value.key.empty() && !follow && now != value.value) changes.push_back({value.key, value.unit, value.value, now});
  }
  for (const EffectiveValue& value : second) {
    if (before.count(value.key) == 0) changes.push_back({value.key, value.unit, "", value.value});
  }
  return changes;
}

std::vector<EffectiveValue> identity_values(std::uint32_t id, std::uint32_t version) {
  return {{"mission.id", std::to_string(id), "", "", ""}, {"mission.version", std::to_string(version), "", "", ""}};
}

std::vector<EffectiveValue> values_of(const MissionParameters& parameters) {
  std::vector<EffectiveValue> values;
  for (const ParameterRow& row : parameter_rows()) {
    const std::string unit = row.unit;
    values.push_back({row.key, value_text(value_row(row), {parameters.*row.member}), unit == "1" ? "" : unit, "", row.meaning});
  }
  return values;
}

std::vector<EffectiveValue> override_values(const MissionSource& source) {
  std::vector<EffectiveValue> values;
  for (const auto& [name, scenario] : source.scenarios) {
    for (const auto& [key, value] : scenario.overrides) {
      const ValueRow& row = *find_row(flight_rows(), key);
      values.push_back(
          {"scenario." + name + ".override." + key, toml_text(row, {value}), row.unit == "1" ? "" : row.unit, "", row.meaning});
    }
  }
  return values;
}

}  // namespace lasso::mdat
