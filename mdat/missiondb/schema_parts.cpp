#include "mdat/missiondb/schema_parts.hpp"

#include <sstream>

namespace lasso::mdat {
namespace {

Json number(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

Json preset_of(const ValueRow& row) {
  if (row.kind == ValueKind::kBoolean) return row.preset[0] != 0;
  if (row.kind == ValueKind::kChoice) return row.choices.at(static_cast<std::size_t>(row.preset[0]));
  if (row.kind != ValueKind::kReals) return number(row.preset[0]);
  Json list = Json::array();
  for (const double value : row.preset) list.push_back(number(value));
  return list;
}

Json number_schema(const ValueRow& row) {
  return {
      {"type", row.kind == ValueKind::kInteger ? "integer" : "number"}, {"minimum", number(row.minimum)}, {"maximum", number(row.maximum)}};
}

Json one_text(const ValueRow& row) { return {{"type", "string"}, {"pattern", "^(" + row.pattern + ")$"}}; }

Json text_schema(const ValueRow& row) {
  if (row.count_max == 1) return one_text(row);
  const Json list = {{"type", "array"}, {"minItems", 1}, {"maxItems", row.count_max}, {"items", one_text(row)}};
  return {{"anyOf", {one_text(row), list}}};
}

}  // namespace

Json value_schema(const ValueRow& row) {
  switch (row.kind) {
    case ValueKind::kBoolean:
      return {{"type", "boolean"}};
    case ValueKind::kChoice:
      return {{"type", "string"}, {"enum", row.choices}};
    case ValueKind::kText:
      return text_schema(row);
    case ValueKind::kReals:
      return {{"type", "array"}, {"minItems", row.count_min}, {"maxItems", row.count_max}, {"items", number_schema(row)}};
    case ValueKind::kReal:
    case ValueKind::kInteger:
      break;
  }
  return number_schema(row);
}

Json described(const ValueRow& row, bool with_preset) {
  Json schema = value_schema(row);
  schema["description"] = row.meaning + (row.preset_from.empty() ? "" : " (as " + row.preset_from + " where not given)");
  if (!row.unit.empty() && row.unit != "1") schema["x-unit"] = row.unit;
  if (with_preset && !row.preset.empty()) schema["default"] = preset_of(row);
  return schema;
}

Json closed_object() { return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}}; }

Json& owner_of(Json& root, const std::string& key, std::string& last) {
  std::istringstream parts(key);
  Json* object = &root;
  std::getline(parts, last, '.');
  for (std::string next; std::getline(parts, next, '.'); last = next) {
    Json& properties = (*object)["properties"];
    if (!properties.contains(last)) properties[last] = closed_object();
    object = &properties[last];
  }
  return *object;
}

void add_rows(Json& root, const std::vector<ValueRow>& rows, bool with_presets) {
  for (const ValueRow& row : rows) {
    std::string last;
    Json& owner = owner_of(root, row.key, last);
    owner["properties"][last] = described(row, with_presets);
    if (row.required) owner["required"].push_back(last);
  }
}

}  // namespace lasso::mdat
