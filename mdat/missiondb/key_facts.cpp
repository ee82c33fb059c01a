#include "mdat/missiondb/key_facts.hpp"

#include <algorithm>

#include "mdat/missiondb/mission_checks.hpp"
#include "mdat/missiondb/mission_schema.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/schema_parts.hpp"
#include "mdat/missiondb/settings.hpp"

namespace lasso::mdat {
namespace {

constexpr char kAnyName[] = "NAME";

const Json& schema() {
  static const Json parsed = Json::parse(mission_schema_text());
  return parsed;
}

// A place in the schema, by the key that leads there.
struct SchemaPlace {
  std::string key;
  const Json* schema;
};
using SchemaPlaces = std::vector<SchemaPlace>;

// The forms of an object: one, or several of which one holds.
SchemaPlaces forms(const SchemaPlace& place) {
  const Json& schema = *place.schema;
  if (!schema.contains("oneOf") || !schema["oneOf"][0].contains("properties")) return {place};
  SchemaPlaces result;
  for (const Json& form : schema["oneOf"]) result.push_back({place.key, &form});
  return result;
}

std::string joined(const std::string& table, const std::string& name) { return table.empty() ? name : table + "." + name; }

// What stands directly in it; where names are chosen, under NAME.
SchemaPlaces children(const SchemaPlace& place) {
  SchemaPlaces result;
  for (const SchemaPlace& form : forms(place)) {
    const Json& schema = *form.schema;
    if (schema.contains("properties")) {
      for (const auto& [name, value] : schema["properties"].items()) result.push_back({joined(place.key, name), &value});
    }
    if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object())
      result.push_back({joined(place.key, kAnyName), &schema["additionalProperties"]});
  }
  return result;
}

SchemaPlaces places_of(const std::string& key) {
  SchemaPlaces places{{"", &schema()}};
  for (const std::string& name : names_of_key(key)) {
    SchemaPlaces next;
    for (const SchemaPlace& place : places) {
      for (const SchemaPlace& child : children(place)) {
        if (child.key == joined(place.key, name)) next.push_back(child);
        if (child.key == joined(place.key, kAnyName)) next.push_back({joined(place.key, name), child.schema});
      }
    }
    places = next;
  }
  return places;
}

std::string toml_of_json(const Json& value) {
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : ", ") + toml_of_json(item);
  return "[" + text + "]";
}

std::string choices_text(const Json& choices) {
  std::string text;
  for (const Json& choice : choices) text += (text.empty() ? "" : ", ") + choice.dump();
  return choices.size() == 1 ? text : "one of " + text;
}

std::string bounds_text(const Json& number, const std::string& unit) {
  return number.value("type", "") == "integer"
             ? "a whole number from " + number["minimum"].dump() + " to " + number["maximum"].dump() + unit
             : "a number from " + number["minimum"].dump() + " to " + number["maximum"].dump() + unit;
}

std::string list_text(const Json& schema, const std::string& unit) {
  const std::string least = schema.contains("minItems") ? schema["minItems"].dump() : "1";
  const std::string most = schema.contains("maxItems") ? schema["maxItems"].dump() : "any number";
  const std::string count = least == most ? least : least + " to " + most;
  const Json& items = schema["items"];
  if (items.contains("minimum")) return "a list of " + count + ", each " + bounds_text(items, unit);
  return "a list of " + count + (items.value("type", "") == "string" ? " texts" : " tables");
}

// Of a value; empty for a table.
std::string expected_text(const Json& schema, const std::string& unit) {
  if (schema.contains("$ref")) return "a law, such as { uniform = [1, 2] }";  // definitions/law, the only one
  if (schema.contains("const")) return choices_text({schema["const"]});
  if (schema.contains("enum")) return choices_text(schema["enum"]);
  if (schema.contains("anyOf")) return expected_text(schema["anyOf"][0], unit) + ", or " + expected_text(schema["anyOf"][1], unit);
  const std::string type = schema.value("type", "");
  if (type == "boolean") return "true or false";
  if (type == "string") return "a text";
  if (type == "array") return list_text(schema, unit);
  return type == "object" || type.empty() ? "" : bounds_text(schema, unit);
}

KeyFacts facts(const SchemaPlace& place) {
  const Json& schema = *place.schema;
  const std::string unit = schema.value("x-unit", "");
  KeyFacts result;
  result.key = place.key;
  result.expected = expected_text(schema, unit.empty() ? "" : " " + unit);
  result.table = result.expected.empty();
  result.meaning = schema.value("description", "");
  result.unit = unit;
  if (schema.contains("default")) result.preset = toml_of_json(schema["default"]);
  return result;
}

void add_keys(const SchemaPlace& place, std::vector<std::string>& keys) {
  for (const SchemaPlace& child : children(place)) {
    if (!facts(child).table) keys.push_back(child.key);
    if (facts(child).table) add_keys(child, keys);
  }
}

bool contains_key(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

std::vector<KeyFacts> facts_of(const std::string& key) {
  std::vector<KeyFacts> result;
  for (const SchemaPlace& place : places_of(key)) result.push_back(facts(place));
  return result;
}

std::vector<KeyFacts> keys_in(const std::string& table) {
  std::vector<KeyFacts> result;
  for (const SchemaPlace& place : places_of(table)) {
    for (const SchemaPlace& child : children(place)) {
      const auto is_there = [&](const KeyFacts& known) { return known.key == child.key; };
      if (std::none_of(result.begin(), result.end(), is_there)) result.push_back(facts(child));
    }
  }
  return result;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  add_keys({"", &schema()}, keys);
  return keys;
}

std::vector<std::string> checked_with(const std::string& key) {
  std::vector<std::string> result;
  for (const Rule& rule : all_rules()) {
    const std::vector<std::string> keys(rule.keys.begin(), rule.keys.end());
    if (!contains_key(keys, key)) continue;
    for (const std::string& other : keys) {
      if (other != key && !contains_key(result, other)) result.push_back(other);
    }
  }
  return result;
}

}  // namespace lasso::mdat
