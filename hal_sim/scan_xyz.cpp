// Points of a plain text cloud (.asc, .xyz, .pts): a row a point, its coordinates the first three columns, or those that a header names.
// Separated by blanks, tabs, commas or semicolons; with decimal commas where these do not separate. A header may be marked as a remark
// (//X Y Z); a first row of one number is the count of points.
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

using Tokens = std::vector<std::string_view>;

using Columns = std::array<std::size_t, 3>;  // of x, y and z

// A line before the first point that may name the columns.
struct Naming {
  std::string_view line;
  std::string place;
  bool remark = false;
};

bool is_remark(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//") || line.starts_with('%') || line.starts_with('!');
}

// A separator at the end of a line begins no field.
Tokens fields_of(std::string_view line, char separator) {
  Tokens fields = separator == ' ' ? words(line) : split(line, separator);
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

// Which axis a column's name is of: "x", "X", "x_m", "x[m]", "X (m)", "\"x\"". "x right" is a sentence.
std::optional<std::size_t> axis_of(std::string_view name) {
  while (!name.empty() && (name.front() == '"' || name.front() == '/' || name.front() == '#')) name.remove_prefix(1);
  if (name.empty()) return std::nullopt;
  const std::size_t axis = std::string_view("xyz").find(static_cast<char>(std::tolower(static_cast<unsigned char>(name[0]))));
  const std::string_view unit = trimmed(name.substr(1));
  const bool alone = unit.empty() || (std::isalnum(static_cast<unsigned char>(unit[0])) == 0);
  return axis < 3 && alone ? std::optional(axis) : std::nullopt;
}

// The names of a line, by the first of the separators that it has.
Tokens names_of(std::string_view line) {
  while (!line.empty() && (is_remark(line) || line.front() == '/' || line.front() == ' ')) line.remove_prefix(1);
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return fields_of(line, separator);
  }
  return words(line);
}

// Nothing where the names lack an axis.
std::optional<Columns> axes_among(const Tokens& names) {
  Columns found{names.size(), names.size(), names.size()};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto axis = axis_of(names[i]);
    if (axis && found[*axis] == names.size()) found[*axis] = i;
  }
  if (std::find(found.begin(), found.end(), names.size()) != found.end()) return std::nullopt;
  return found;
}

// By the last line that names them: one name for each field of a row. A remark that does not may be a sentence; a header that does not is
// refused, unless x, y and z are its first.
Columns columns_of(const std::vector<Naming>& namings, std::size_t fields) {
  constexpr Columns kFirst = {0, 1, 2};
  Columns columns = kFirst;
  for (const Naming& naming : namings) {
    const Tokens names = names_of(naming.line);
    const auto named = axes_among(names);
    if (named && (names.size() == fields || *named == kFirst)) {
      columns = *named;
    } else if (!naming.remark) {
      fail(naming.place, "the header is " + shown(naming.line) + ", with " + std::to_string(names.size()) + " names for rows of " +
                             std::to_string(fields) + " values; name each column");
    }
  }
  return columns;
}

// One separator for the whole file: what stands between the numbers of its first row.
char separator_of(std::string_view row) {
  if (row.find(';') != std::string_view::npos) return ';';
  if (row.find(',') == std::string_view::npos) return ' ';
  const Tokens blanks = words(row);
  const bool decimal = blanks.size() > 2 && std::all_of(blanks.begin(), blanks.end(), [](std::string_view word) {
                         return !word.starts_with(',') && !word.ends_with(',') && std::count(word.begin(), word.end(), ',') <= 1;
                       });
  return decimal ? ' ' : ',';
}

double coordinate(std::string_view field, std::size_t axis, bool decimal_comma, const std::string& place) {
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  std::string text(field);
  if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  return any_number(text, kAxes[axis], place);
}

bool is_number(std::string_view field) { return !field.empty() && field.find_first_not_of("0123456789") == std::string_view::npos; }

void read_point(std::string_view line, char separator, const Columns& columns, const std::string& place, std::size_t row, RawScan& scan) {
  const Tokens fields = fields_of(line, separator);
  Vec3 point = Vec3::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (columns[axis] >= fields.size()) {
      fail(place, "the row has " + std::to_string(fields.size()) + " values, expected at least x, y and z; the row is " + shown(line));
    }
    point[static_cast<Eigen::Index>(axis)] = coordinate(fields[columns[axis]], axis, separator != ',', place);
  }
  scan.add_point(point, 0, row);
}

bool is_header(std::string_view line, const std::string& place) {
  if (std::isalpha(static_cast<unsigned char>(line.front())) == 0 && line.front() != '"') return false;
  if (line.starts_with("nan") || line.starts_with("NaN") || line.starts_with("inf")) return false;
  if (!axes_among(names_of(line))) fail(place, "the header is " + shown(line) + ", expected columns x, y and z among its own");
  return true;
}

// Takes in what stands before the first point; false for a point. `first`: of the lines that are no remarks.
bool take_heading(std::string_view line, bool first, const std::string& place, std::vector<Naming>& namings) {
  if (!is_remark(line) && first && is_number(line)) return true;
  if (!is_remark(line) && !is_header(line, place)) return false;
  namings.push_back({line, place, is_remark(line)});
  return true;
}

}  // namespace

RawScan read_xyz(const std::string& file, std::string_view text) {
  Lines lines(file, without_mark(text));
  RawScan scan;
  scan.file = file;
  scan.rows_are_lines = true;
  std::vector<Naming> namings;
  Columns columns{};
  char separator = 0;
  bool first = true;
  std::string_view line;
  while (lines.next(line)) {
    line = trimmed(line);
    const bool remark = is_remark(line);
    if (line.empty() || (separator != 0 && remark)) continue;
    const bool heading = separator == 0 && take_heading(line, first, lines.place(), namings);
    first = first && remark;
    if (heading) continue;
    if (separator == 0) {
      separator = separator_of(line);
      columns = columns_of(namings, fields_of(line, separator).size());
    }
    read_point(line, separator, columns, lines.place(), lines.number(), scan);
  }
  if (separator == 0) fail(at_line(file, std::max<std::size_t>(lines.number(), 1)), "there is no point; a scan needs at least one");
  return scan;
}

}  // namespace lasso::sim
