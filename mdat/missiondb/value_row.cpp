#include "mdat/missiondb/value_row.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace lasso::mdat {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

ValueKind value_kind(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kInteger:
      return ValueKind::kInteger;
    case ParameterKind::kBoolean:
      return ValueKind::kBoolean;
    case ParameterKind::kChoice:
      return ValueKind::kChoice;
    case ParameterKind::kReal:
      break;
  }
  return ValueKind::kReal;
}

std::string item_text(const ValueRow& row, double value) {
  if (row.kind == ValueKind::kBoolean) return value != 0 ? "true" : "false";
  if (row.kind == ValueKind::kChoice) return '"' + row.choices.at(static_cast<std::size_t>(value)) + '"';
  return number_text(value);
}

}  // namespace

ValueRow number_row(const char* key, const char* unit, ValueKind kind, double to_si, double minimum, double maximum, double preset,
                    const char* meaning) {
  ValueRow row;
  row.key = key;
  row.unit = unit;
  row.kind = kind;
  row.to_si = to_si;
  row.minimum = minimum;
  row.maximum = maximum;
  row.preset = {preset};
  row.meaning = meaning;
  return row;
}

ValueRow text_row(const char* key, const char* pattern, const char* meaning) {
  ValueRow row;
  row.key = key;
  row.kind = ValueKind::kText;
  row.pattern = pattern;
  row.meaning = meaning;
  return row;
}

ValueRow required(ValueRow row) {
  row.preset.clear();
  row.required = true;
  return row;
}

ValueRow list_row(ValueRow row, std::size_t count, std::vector<double> preset) {
  row.kind = ValueKind::kReals;
  row.count_min = count;
  row.count_max = count;
  row.preset = std::move(preset);
  return row;
}

ValueRow value_row(const ParameterRow& row) {
  ValueRow result;
  result.key = row.key;
  result.unit = row.unit;
  result.kind = value_kind(row.kind);
  result.to_si = row.to_si;
  result.minimum = row.minimum;
  result.maximum = row.maximum;
  result.preset = {row.preset};
  result.choices = split(row.choices, '|');
  result.meaning = row.meaning;
  return result;
}

const std::vector<ValueRow>& flight_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result;
    for (const ParameterRow& row : parameter_rows()) result.push_back(value_row(row));
    return result;
  }();
  return rows;
}

const ValueRow* find_row(const std::vector<ValueRow>& rows, const std::string& key) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ValueRow& row) { return row.key == key; });
  return found == rows.end() ? nullptr : &*found;
}

std::string range_text(const ValueRow& row) {
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " " + row.unit;
  return number_text(row.minimum) + " to " + number_text(row.maximum) + unit;
}

std::string expectation(const ValueRow& row) {
  switch (row.kind) {
    case ValueKind::kReal:
      return "expected a number from " + range_text(row);
    case ValueKind::kInteger:
      return "expected a whole number from " + range_text(row);
    case ValueKind::kBoolean:
      return "expected true or false, without quotes";
    case ValueKind::kText:
      return std::string("expected a text in quotes") +
             (row.count_max > 1 ? ", or a list of at most " + std::to_string(row.count_max) : std::string());
    case ValueKind::kChoice:
      break;
    case ValueKind::kReals: {
      const std::string upper = row.count_max == row.count_min ? "" : " to " + std::to_string(row.count_max);
      return "expected a list of " + std::to_string(row.count_min) + upper + " numbers, each from " + range_text(row);
    }
  }
  std::string names;
  for (const std::string& choice : row.choices) names += (names.empty() ? "\"" : ", \"") + choice + '"';
  return "expected one of " + names;
}

std::string number_text(double value) {
  constexpr double kLongestWhole = 1e15;
  constexpr double kLeastWithoutExponent = 1e-4;
  if (std::fabs(value) < kLongestWhole && value == std::trunc(value)) return std::to_string(static_cast<long long>(value));
  char buffer[32];
  const bool plain = std::fabs(value) >= kLeastWithoutExponent && std::fabs(value) < kLongestWhole;
  const auto end = plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                         : std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::string toml_text(const ValueRow& row, const std::vector<double>& value) {
  if (row.kind != ValueKind::kReals) return item_text(row, value.at(0));
  std::string text;
  for (const double item : value) text += (text.empty() ? "" : ", ") + item_text(row, item);
  return "[" + text + "]";
}

std::string value_text(const ValueRow& row, std::vector<double> si) {
  for (double& value : si) {
    value /= row.to_si;
    std::ostringstream rounded;
    rounded << std::setprecision(12) << value;
    value = std::stod(rounded.str());
  }
  return toml_text(row, si);
}

}  // namespace lasso::mdat
