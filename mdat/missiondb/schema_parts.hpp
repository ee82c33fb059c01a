// What the schema of missions is made of: objects that know all their keys, and values by rows. Inside of missiondb.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {

using Json = nlohmann::ordered_json;

// Without its description.
Json value_schema(const ValueRow& row);

// With its meaning, its unit (x-unit) and, where wanted, its preset.
Json described(const ValueRow& row, bool with_preset);

Json closed_object();

// Puts each row into the object of its dotted key, which is made where it does not exist.
void add_rows(Json& root, const std::vector<ValueRow>& rows, bool with_presets);

// The object in which the last part of a dotted key belongs, made where it does not exist.
Json& owner_of(Json& root, const std::string& key, std::string& last);

// All campaigns, by their names.
Json campaigns_schema();

// Of definitions/law.
Json law_schema();

}  // namespace lasso::mdat
