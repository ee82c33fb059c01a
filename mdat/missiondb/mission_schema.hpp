// The JSON Schema (draft-07) of missions, made from the rows that the loader checks with: cfg/mission.schema.json is this, written down.
#pragma once

#include <string>

namespace lasso::mdat {

// Ends with a line feed.
std::string mission_schema_text();

}  // namespace lasso::mdat
