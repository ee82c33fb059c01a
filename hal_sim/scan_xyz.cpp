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

struct CloudColumns {
  std::array<std::size_t, 3> xyz = {0, 1, 2};
  bool named = false;
};

bool is_remark(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//") || line.starts_with('%') || line.starts_with('!');
}

// By blanks and any of the separators.
Tokens pieces(std::string_view line) {
  Tokens found;
  constexpr std::string_view kBetween = " \t,;";
  for (std::size_t i = line.find_first_not_of(kBetween); i < line.size(); i = line.find_first_not_of(kBetween, i)) {
    const std::size_t end = std::min(line.find_first_of(kBetween, i), line.size());
    found.push_back(line.substr(i, end - i));
    i = end;
  }
  return found;
}

// Which axis a column's name is of: "x", "X", "x_m", "x[m]", "\"x\"".
std::optional<std::size_t> axis_of(std::string_view name) {
  while (!name.empty() && (name.front() == '"' || name.front() == '/' || name.front() == '#')) name.remove_prefix(1);
  if (name.empty()) return std::nullopt;
  const std::size_t axis = std::string_view("xyz").find(static_cast<char>(std::tolower(static_cast<unsigned char>(name[0]))));
  const bool alone = name.size() == 1 || std::isalnum(static_cast<unsigned char>(name[1])) == 0;
  return axis < 3 && alone ? std::optional(axis) : std::nullopt;
}

// False where the words are not a header.
bool read_names(std::string_view line, CloudColumns& columns) {
  while (!line.empty() && (is_remark(line) || line.front() == '/' || line.front() == ' ')) line.remove_prefix(1);
  std::array<bool, 3> found{};
  const Tokens names = pieces(line);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto axis = axis_of(names[i]);
    if (!axis || found[*axis]) continue;
    columns.xyz[*axis] = i;
    found[*axis] = true;
  }
  columns.named = found[0] && found[1] && found[2];
  if (!columns.named) columns.xyz = {0, 1, 2};
  return columns.named;
}

// One separator for the whole file: what stands between the numbers of its first row.
char separator_of(std::string_view row) {
  if (row.find(';') != std::string_view::npos) return ';';
  if (row.find(',') == std::string_view::npos) return ' ';
  const Tokens blanks = words(row);
  const bool decimal = blanks.size() > 2 && std::all_of(blanks.begin(), blanks.end(), [](std::string_view word) {
                         return !word.ends_with(',') && std::count(word.begin(), word.end(), ',') <= 1;
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

void read_point(std::string_view line, char separator, const CloudColumns& columns, const std::string& place, std::size_t row,
                RawScan& scan) {
  const Tokens fields = separator == ' ' ? words(line) : split(line, separator);
  Vec3 point = Vec3::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (columns.xyz[axis] >= fields.size()) {
      fail(place, "the row has " + std::to_string(fields.size()) + " values, expected at least x, y and z; the row is " + shown(line));
    }
    point[static_cast<Eigen::Index>(axis)] = coordinate(fields[columns.xyz[axis]], axis, separator != ',', place);
  }
  scan.add_point(point, 0, row);
}

// A header or a count, before the first point.
bool is_heading(std::string_view line, bool first, CloudColumns& columns, const std::string& place) {
  const Tokens fields = pieces(line);
  if (first && fields.size() == 1 && is_number(fields[0])) return true;
  if (std::isalpha(static_cast<unsigned char>(line.front())) == 0 && line.front() != '"') return false;
  if (line.starts_with("nan") || line.starts_with("NaN") || line.starts_with("inf")) return false;
  if (!read_names(line, columns)) fail(place, "the header is " + shown(line) + ", expected columns x, y and z among its own");
  return true;
}

}  // namespace

RawScan read_xyz(const std::string& file, std::string_view text) {
  Lines lines(file, without_mark(text));
  RawScan scan;
  scan.file = file;
  scan.rows_are_lines = true;
  CloudColumns columns;
  char separator = 0;
  bool first = true;
  std::string_view line;
  while (lines.next(line)) {
    line = trimmed(line);
    if (line.empty()) continue;
    if (is_remark(line)) {
      if (separator == 0) static_cast<void>(read_names(line, columns));
      continue;
    }
    const bool heading = separator == 0 && is_heading(line, first, columns, lines.place());
    first = false;
    if (heading) continue;
    if (separator == 0) separator = separator_of(line);
    read_point(line, separator, columns, lines.place(), lines.number(), scan);
  }
  if (separator == 0) fail(at_line(file, std::max<std::size_t>(lines.number(), 1)), "there is no point; a scan needs at least one");
  return scan;
}

}  // namespace lasso::sim
