// Campaigns in the schema of missions: what may vary, by which laws, what is asked.
#include "mdat/missiondb/campaign_columns.hpp"
#include "mdat/missiondb/campaign_rows.hpp"
#include "mdat/missiondb/schema_parts.hpp"

namespace lasso::mdat {
namespace {

Json number_or_law(ValueRow row) {
  if (row.kind == ValueKind::kReals) row.kind = ValueKind::kReal;
  return {{"anyOf", {value_schema(row), {{"$ref", "#/definitions/law"}}}}};
}

Json list_of_laws(const ValueRow& row) {
  Json list = {{"type", "array"}, {"minItems", row.count_max}, {"maxItems", row.count_max}, {"items", number_or_law(row)}};
  if (row.count_max != 3) return list;
  Json direction = closed_object();
  direction["properties"]["any_direction"] = {{"anyOf", {{{"type", "number"}, {"minimum", 0}}, {{"$ref", "#/definitions/law"}}}}};
  direction["required"] = {"any_direction"};
  return {{"anyOf", {list, direction}}};
}

Json described_laws(const ValueRow& row) {
  Json schema = row.kind == ValueKind::kReals ? list_of_laws(row) : number_or_law(row);
  schema["description"] = row.meaning;
  if (!row.unit.empty() && row.unit != "1") schema["x-unit"] = row.unit;
  return schema;
}

Json laws_schema(const std::vector<ValueRow>& rows, const char* meaning) {
  Json schema = closed_object();
  schema["description"] = meaning;
  for (const ValueRow& row : rows) {
    std::string last;
    Json& owner = owner_of(schema, row.key, last);
    owner["properties"][last] = described_laws(row);
  }
  return schema;
}

Json truth_schema() {
  Json schema = laws_schema(truth_rows(), "what is simulated: keys of the scenario, each a number or a law");
  schema["properties"]["attitude"] = {
      {"type", "string"}, {"enum", {"any"}}, {"description", "roll, tilt and boresight: each attitude is as likely as any other"}};
  const Json file = {{"type", "string"}};
  schema["properties"][kFaultsKey] = {{"anyOf", {file, {{"type", "array"}, {"minItems", 1}, {"items", file}}}},
                                      {"description", "scripts of camera faults, files: each case has one of them"}};
  return schema;
}

Json rows_schema(const std::vector<ValueRow>& rows) {
  Json schema = closed_object();
  add_rows(schema, rows, true);
  return schema;
}

Json together_schema() {
  Json schema = rows_schema(together_rows());
  const Json line = {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "number"}}}};
  schema["properties"]["covariance"] = {
      {"type", "array"}, {"minItems", 1}, {"items", line}, {"description", "by rows, as many as keys; symmetric, positive definite"}};
  return {{"type", "array"}, {"items", schema}};
}

Json pair_schema(const char* meaning) {
  return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", {{"type", "number"}}}, {"description", meaning}};
}

}  // namespace

Json law_schema() {
  Json schema = closed_object();
  Json& laws = schema["properties"];
  laws["uniform"] = pair_schema("lowest and highest, each number between as likely as any other");
  laws["log_uniform"] = pair_schema("lowest and highest, above 0: the logarithm is uniform");
  laws["normal"] = pair_schema("mean and sigma");
  laws["within"] = pair_schema("of a normal law: what lies beyond is never drawn");
  laws["one_of"] = {{"type", "array"}, {"minItems", 1}, {"description", "one of these values"}};
  laws["weights"] = {{"type", "array"},
                     {"minItems", 1},
                     {"items", {{"type", "number"}, {"exclusiveMinimum", 0}}},
                     {"description", "of one_of: how likely each is, of any sum"}};
  Json one = Json::array();
  for (const char* law : {"uniform", "log_uniform", "normal", "one_of"}) one.push_back({{"required", {law}}});
  schema["oneOf"] = one;
  return schema;
}

Json campaigns_schema() {
  Json schema = rows_schema(campaign_rows());
  schema["properties"]["truth"] = truth_schema();
  schema["properties"]["mission"] = laws_schema(belief_rows(), "what the component believes: flight parameters, each a number or a law");
  schema["properties"]["together"] = together_schema();
  schema["properties"]["criteria"] = {{"type", "object"}, {"additionalProperties", rows_schema(criterion_rows())}};
  return {{"type", "object"}, {"additionalProperties", schema}};
}

}  // namespace lasso::mdat
