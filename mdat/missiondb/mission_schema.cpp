#include "mdat/missiondb/mission_schema.hpp"

#include "cfg/capacities.hpp"
#include "mdat/missiondb/material_reader.hpp"
#include "mdat/missiondb/motion_reader.hpp"
#include "mdat/missiondb/node_reader.hpp"
#include "mdat/missiondb/schema_parts.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/sensor_reader.hpp"
#include "mdat/missiondb/stereo_reader.hpp"

namespace lasso::mdat {
namespace {

Json scenario_schema() {
  Json schema = closed_object();
  add_rows(schema, scenario_rows(), true);
  Json overrides = closed_object();
  add_rows(overrides, flight_rows(), false);
  overrides["description"] = "flight parameters that differ in this scenario";
  schema["properties"]["override"] = overrides;
  schema["properties"]["motion"] = {{"type", "object"},
                                    {"additionalProperties", {{"type", "string"}}},
                                    {"description", "without ranges_m: motions by node, in place of the nodes' own"}};
  return schema;
}

Json motion_schema() {
  Json kinds = Json::array();
  for (const MotionKind& kind : motion_kinds()) {
    Json schema = closed_object();
    schema["description"] = kind.meaning;
    schema["properties"]["kind"] = {{"const", kind.name}};
    schema["required"] = {"kind"};
    add_rows(schema, kind.rows, true);
    if (!kind.list.empty()) {
      Json item = closed_object();
      add_rows(item, kind.list_rows, true);
      schema["properties"][kind.list] = {{"type", "array"}, {"minItems", 1}, {"items", item}};
      schema["required"].push_back(kind.list);
    }
    kinds.push_back(schema);
  }
  return {{"oneOf", kinds}};
}

void add_scene(Json& schema) {
  Json node = closed_object();
  add_rows(node, node_rows(), true);
  Json orbit = closed_object();
  add_rows(orbit, orbit_rows(), true);
  schema["properties"]["orbit"] = orbit;
  schema["properties"]["motion"] = {{"type", "object"}, {"additionalProperties", motion_schema()}};
  Json material = closed_object();
  add_rows(material, material_rows(), false);
  schema["properties"]["material"] = {{"type", "object"}, {"additionalProperties", material}};
  Json relative = closed_object();
  add_rows(relative, relative_rows(), true);
  Json stereo = closed_object();
  add_rows(stereo, stereo_rows(), true);
  schema["properties"]["stereo"] = stereo;
  schema["properties"]["relative"] = {{"type", "object"}, {"additionalProperties", relative}};
  schema["properties"]["node"] = {{"type", "object"}, {"additionalProperties", node}};
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
  add_scene(schema);
  schema["properties"]["scenario"] = {{"type", "object"}, {"additionalProperties", scenario_schema()}};
  schema["properties"]["campaign"] = campaigns_schema();
  schema["definitions"] = {{"law", law_schema()}};
  return schema.dump(2) + "\n";
}

}  // namespace lasso::mdat
