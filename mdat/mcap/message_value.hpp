// Messages of any definition as values, and back: what merging, exports and other people's recordings are read by.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "mdat/mcap/definition.hpp"

namespace lasso::mdat::mcap {

// An object of its fields, in order; a sequence of bytes is binary, other ones are arrays.
using MessageValue = nlohmann::ordered_json;

// Throws std::invalid_argument: the message is not as its definition says (too short, too long, no little-endian CDR).
MessageValue value_of(const Definition& definition, std::string_view message);

// The message again. `value` as value_of gave it, or changed within its types.
std::string message_of(const Definition& definition, const MessageValue& value);

}  // namespace lasso::mdat::mcap
