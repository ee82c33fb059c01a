#include "hal_sim/csv_table.hpp"

#include <algorithm>
#include <cctype>

namespace lasso::sim {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// The first of them that the header has.
char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

// "1,5" is a number where commas separate nothing.
std::string with_decimal_point(std::string_view field) {
  std::string text(field);
  if (std::count(text.begin(), text.end(), ',') == 1) std::replace(text.begin(), text.end(), ',', '.');
  return text;
}

}  // namespace

CsvTable::CsvTable(std::string file, std::string_view text, std::string expected)
    : lines_(std::move(file), without_mark(text)), expected_(std::move(expected)) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    fail(at_line(lines_.file(), 1) + ":1", "the text is UTF-16; save it as CSV UTF-8");
  }
  read_header();
}

// A remark before it has none of its separators.
void CsvTable::read_header() {
  std::string_view line;
  while (lines_.next(line)) {
    std::string_view names = trimmed(line);
    const bool marked = names.starts_with('#') || names.starts_with("//");  // as CloudCompare marks it
    while (marked && (names.starts_with('#') || names.starts_with('/'))) names.remove_prefix(1);
    separator_ = separator_of(names);
    if (names.empty() || (marked && names.find(separator_) == std::string_view::npos)) continue;
    header_ = line;
    header_line_ = lines_.number();
    for (const Field& field : split(names)) {
      names_.push_back(lower(field.text));
      name_begins_.push_back(static_cast<std::size_t>(names.data() - line.data()) + field.begin);
    }
    if (names_.size() > 1 && names_.back().empty()) names_.pop_back();
    return;
  }
  fail(at_line(lines_.file(), 1) + ":1", "the file is empty, expected the header " + shown(expected_));
}

std::string CsvTable::header_place(std::size_t column) const {
  return at_line(lines_.file(), header_line_) + ":" + std::to_string(name_begins_.at(column) + 1);
}

void CsvTable::refuse_header() const {
  fail(at_line(lines_.file(), header_line_) + ":1", "the header is " + shown(header_) + ", expected " + shown(expected_));
}

std::optional<std::size_t> CsvTable::find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  }
  return std::nullopt;
}

std::size_t CsvTable::need(std::initializer_list<std::string_view> names) const {
  const auto found = find(names);
  if (!found) refuse_header();
  return *found;
}

// A separator between quotes separates nothing.
std::vector<CsvTable::Field> CsvTable::split(std::string_view line) const {
  std::vector<Field> fields;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != separator_)) continue;
    std::string_view text = trimmed(line.substr(begin, i - begin));
    const std::size_t blanks = static_cast<std::size_t>(text.data() - line.data());
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
    fields.push_back({text, text.empty() ? begin : blanks});
    begin = i + 1;
  }
  return fields;
}

bool CsvTable::next() {
  std::string_view line;
  while (lines_.next(line)) {
    if (trimmed(line).starts_with('#')) continue;
    fields_ = split(line);
    if (std::all_of(fields_.begin(), fields_.end(), [](const Field& field) { return field.text.empty(); })) continue;
    if (fields_.size() == names_.size() + 1 && fields_.back().text.empty()) fields_.pop_back();
    if (fields_.size() == names_.size()) return true;
    fail(place(), "the row has " + std::to_string(fields_.size()) + " fields, expected " + std::to_string(names_.size()) +
                      " as the header; the row is " + shown(line));
  }
  return false;
}

double CsvTable::number(std::size_t column) const {
  const std::string_view text = field(column);
  if (separator_ == ',' || text.find(',') == std::string_view::npos) return sim::number(text, name(column), place(column));
  return sim::number(with_decimal_point(text), name(column), place(column));
}

bool CsvTable::yes_or_no(std::size_t column) const {
  const std::string text = lower(field(column));
  for (const char* yes : {"1", "1.0", "true"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"0", "0.0", "false"}) {
    if (text == no) return false;
  }
  fail(place(column), name(column) + " is " + shown(field(column)) + ", expected 1 (yes; a hit) or 0 (no; a miss)");
}

bool CsvTable::says_nothing(std::size_t column) const {
  std::string text = lower(field(column));
  if (text.starts_with('+') || text.starts_with('-')) text.erase(0, 1);
  for (const char* word : {"", "nan", "inf", "infinity", "na", "n/a", "#n/a", "null", "none"}) {
    if (text == word) return true;
  }
  return text.starts_with("nan(");
}

std::string CsvTable::place(std::size_t column) const { return place() + ":" + std::to_string(fields_.at(column).begin + 1); }

}  // namespace lasso::sim
