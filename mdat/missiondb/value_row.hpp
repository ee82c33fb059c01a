// One row per key of a mission file: the loader, the schema, the writer and the reports read the same rows. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "fsw/mission/parameters.hpp"

namespace lasso::mdat {

enum class ValueKind { kReal, kInteger, kBoolean, kChoice, kText, kReals };

struct ValueRow {
  std::string key;  // dotted, from the table that is read
  std::string unit;
  ValueKind kind = ValueKind::kReal;
  double to_si = 1;
  double minimum = 0, maximum = 0;           // inclusive, in `unit`; of each number in a list
  std::vector<double> preset;                // one number, or the list; empty: see `required`
  std::string preset_from;                   // the preset is the effective value of this key
  std::vector<std::string> choices;          // kChoice: value = position
  std::size_t count_min = 1, count_max = 1;  // numbers in a list; texts: more than 1 may be a list
  std::string pattern;                       // kText: ECMA regular expression of the whole
  bool required = false;
  std::string meaning;
};

// A row of one number, and how it becomes another one: a text, one that has to be written, a list of `count` numbers.
ValueRow number_row(const char* key, const char* unit, ValueKind kind, double to_si, double minimum, double maximum, double preset,
                    const char* meaning);
ValueRow text_row(const char* key, const char* pattern, const char* meaning);
ValueRow required(ValueRow row);
ValueRow list_row(ValueRow row, std::size_t count, std::vector<double> preset);

ValueRow value_row(const ParameterRow& row);

// All flight parameters, in the order of parameter_rows().
const std::vector<ValueRow>& flight_rows();

// nullptr if there is none.
const ValueRow* find_row(const std::vector<ValueRow>& rows, const std::string& key);

// "0.1 to 60 deg".
std::string range_text(const ValueRow& row);

// "a number from 0.1 to 60 deg", "true or false", ...
std::string expectation(const ValueRow& row);

// A number as a person writes it: the shortest text that reads back to the same double.
std::string number_text(double value);

// A value (number, or position of a choice, or 0/1) of this row as TOML.
std::string toml_text(const ValueRow& row, const std::vector<double>& value);

// The same of values in SI, without the last digits that the conversion makes up.
std::string value_text(const ValueRow& row, std::vector<double> si);

}  // namespace lasso::mdat
