// Definitions of ROS 2 messages ("ros2msg"): what a reader needs to take apart messages that it does not know.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lasso::mdat::mcap {

enum class Basic : std::uint8_t {
  kNone,
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kText
};

struct Field {
  enum class Many : std::uint8_t { kOne, kFixed, kSequence };
  std::string name;
  Basic basic = Basic::kNone;  // kNone: of type `type`
  std::size_t type = 0;        // in Definition::types
  Many many = Many::kOne;
  std::uint32_t count = 0;  // of kFixed
};

struct MessageType {
  std::string name;  // "package/Type"
  std::vector<Field> fields;
};

struct Definition {
  std::vector<MessageType> types;  // the first is that of the message
};

// `name`: "package/msg/Type"; `text`: its fields, then those of each type that they need, behind lines of "=" and "MSG: package/Type".
// Throws std::invalid_argument that names the line: a type that is not defined, one that holds itself, wide strings.
Definition parse_definition(const std::string& name, const std::string& text);

}  // namespace lasso::mdat::mcap
