#include "mdat/mcap/definition.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace lasso::mdat::mcap {
namespace {

constexpr int kDeepest = 32;
constexpr std::size_t kMostTypes = 1000;

const std::map<std::string, Basic>& basics() {
  static const std::map<std::string, Basic> kBasics = {
      {"bool", Basic::kBool},       {"byte", Basic::kUint8},  {"char", Basic::kUint8},    {"int8", Basic::kInt8},
      {"uint8", Basic::kUint8},     {"int16", Basic::kInt16}, {"uint16", Basic::kUint16}, {"int32", Basic::kInt32},
      {"uint32", Basic::kUint32},   {"int64", Basic::kInt64}, {"uint64", Basic::kUint64}, {"float32", Basic::kFloat32},
      {"float64", Basic::kFloat64}, {"string", Basic::kText}};
  return kBasics;
}

// "package/msg/Type" and "package/Type" are one.
std::string short_name(std::string name) {
  const std::size_t middle = name.find("/msg/");
  return middle == std::string::npos ? name : name.replace(middle, 5, "/");
}

// The fields of one type, as lines.
struct TypeText {
  std::string name;
  std::vector<std::string> lines;
};

std::vector<TypeText> types_of(const std::string& name, const std::string& text) {
  std::vector<TypeText> types{{short_name(name), {}}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.rfind("MSG: ", 0) == 0) {
      types.push_back({short_name(line.substr(5)), {}});
    } else if (line.rfind("===", 0) != 0) {
      types.back().lines.push_back(line);
    }
  }
  return types;
}

[[noreturn]] void refuse_line(const std::string& line, const std::string& why) {
  throw std::invalid_argument("'" + line.substr(0, 80) + "': " + why);
}

// How many elements an array of a fixed length has: what stands between its brackets. None would let a message have any number of them.
std::uint32_t fixed_count(const std::string& digits, const std::string& line) {
  if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) refuse_line(line, "no number of elements");
  const auto count = static_cast<std::uint32_t>(std::stoul(digits));
  if (count == 0) refuse_line(line, "an array of no elements");
  return count;
}

// "float64[36]", "uint8[]", "string<=10", "int32[<=5]": the type without what stands behind it.
std::string take_many(std::string type, const std::string& line, Field& field) {
  const std::size_t open = type.find('['), close = type.find(']');
  if (open != std::string::npos) {
    if (close == std::string::npos || close < open) refuse_line(line, "a bracket is not closed");
    const std::string inner = type.substr(open + 1, close - open - 1);
    const bool fixed = !inner.empty() && inner[0] != '<';
    field.many = fixed ? Field::Many::kFixed : Field::Many::kSequence;
    if (fixed) field.count = fixed_count(inner, line);
    type.resize(open);
  }
  return type.substr(0, type.find("<="));
}

class DefinitionParser {
 public:
  DefinitionParser(const std::string& name, const std::string& text) : texts_(types_of(name, text)) {}

  Definition parse() {
    (void)type_of(texts_.front().name, "", 0);
    return std::move(result_);
  }

 private:
  // Its number; the type and those that it needs are taken once.
  std::size_t type_of(const std::string& name, const std::string& line, int depth) {
    const auto known = numbers_.find(name);
    if (known != numbers_.end()) return known->second;
    const auto text = std::find_if(texts_.begin(), texts_.end(), [&](const TypeText& type) { return type.name == name; });
    if (text == texts_.end()) refuse_line(line, "the type " + name + " is not defined");
    if (depth > kDeepest || result_.types.size() > kMostTypes || open_[name]) refuse_line(line, "types hold each other without end");
    open_[name] = true;
    const std::size_t number = result_.types.size();
    result_.types.push_back({name, {}});
    for (const std::string& field : text->lines) take_line(field, name, number, depth);
    open_[name] = false;
    return numbers_[name] = number;
  }

  void take_line(const std::string& whole, const std::string& owner, std::size_t number, int depth) {
    std::istringstream words(whole.substr(0, whole.find('#')));
    std::string type, name, next;
    if (!(words >> type)) return;
    if (!(words >> name)) refuse_line(whole, "a field has no name");
    words >> next;
    if (name.find('=') != std::string::npos || (!next.empty() && next[0] == '=')) return;  // a constant
    Field field;
    field.name = name;
    type = take_many(type, whole, field);
    const auto basic = basics().find(type);
    if (basic != basics().end()) field.basic = basic->second;
    if (basic == basics().end()) field.type = type_of(full_name(type, owner), whole, depth + 1);
    result_.types[number].fields.push_back(field);
  }

  // A type without a package is of its owner's, but for the header of old.
  static std::string full_name(const std::string& type, const std::string& owner) {
    if (type.find('/') != std::string::npos) return short_name(type);
    return type == "Header" ? "std_msgs/Header" : owner.substr(0, owner.find('/') + 1) + type;
  }

  std::vector<TypeText> texts_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::string, bool> open_;
  Definition result_;
};

}  // namespace

Definition parse_definition(const std::string& name, const std::string& text) { return DefinitionParser(name, text).parse(); }

}  // namespace lasso::mdat::mcap
