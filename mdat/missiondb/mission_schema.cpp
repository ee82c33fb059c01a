#include "mdat/missiondb/mission_schema.hpp"

#include "cfg/capacities.hpp"
#include "mdat/missiondb/schema_parts.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/sensor_reader.hpp"

namespace lasso::mdat {
namespace {

Json scenario_schema() {
  Json schema = closed_object();
  add_rows(schema, scenario_rows(), true);
  Json overrides = closed_object();
  add_rows(overrides, flight_rows(), false);
  overrides["description"] = "flight parameters that differ in this scenario";
  schema["properties"]["override"] = overrides;
  return schema;
}

}  // namespace

std::string mission_schema_text() {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "3DLASSO mission"}};
  schema.update(closed_object());
  schema["required"] = {"mission", "target"};
  add_rows(schema, mission_rows(), true);
  Json& target = schema["properties"]["target"];
  target["oneOf"] = {{{"required", {"model"}}}, {{"required", {"mesh"}}}};
  target["properties"]["parameters"] = {{"type", "object"},
                                        {"additionalProperties", {{"type", "number"}, {"minimum", -1e9}, {"maximum", 1e9}}},
                                        {"description", "values of the parametric model's parameters"}};
  add_rows(schema, flight_rows(), true);
  Json sensor = closed_object();
  add_rows(sensor, further_sensor_rows(), true);
  schema["properties"]["further_sensor"] = {{"type", "object"}, {"maxProperties", kMaxSensors - 1}, {"additionalProperties", sensor}};
  Json part = closed_object();
  add_rows(part, part_rows(), true);
  part["oneOf"] = {{{"required", {"box_m"}}}, {{"required", {"model"}}}, {{"required", {"mesh"}}}};
  schema["properties"]["part"] = {{"type", "object"}, {"maxProperties", kMaxParts}, {"additionalProperties", part}};
  schema["properties"]["scenario"] = {{"type", "object"}, {"additionalProperties", scenario_schema()}};
  schema["properties"]["campaign"] = campaigns_schema();
  schema["definitions"] = {{"law", law_schema()}};
  return schema.dump(2) + "\n";
}

}  // namespace lasso::mdat
