#include "mdat/replay/initial_poses.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

constexpr std::array<std::string_view, 8> kColumns = {"scan", "qx", "qy", "qz", "qw", "x_m", "y_m", "z_m"};
constexpr std::string_view kHeader = "scan,qx,qy,qz,qw,x_m,y_m,z_m";

struct Place {
  std::string file;
  std::size_t line = 0;

  [[noreturn]] void refuse(std::size_t column, const std::string& what) const {
    throw InputError(file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
  }
};

struct Field {
  std::string_view text;
  std::size_t column;  // from 1
};

// Blanks around a field do not belong to it.
Field trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  while (begin < end && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
  while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t')) --end;
  return {line.substr(begin, end - begin), begin + 1};
}

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',', begin)) {
    fields.push_back(trimmed(line, begin, comma));
    begin = comma + 1;
  }
  fields.push_back(trimmed(line, begin, line.size()));
  return fields;
}

std::string in_quotes(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

double number(const Field& field, std::string_view name, const Place& place) {
  double value = 0;
  const char* const begin = field.text.data();  // NOLINT(bugprone-suspicious-stringview-data-usage): its end goes with it
  const char* const end = begin + field.text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || field.text.empty()) {
    place.refuse(field.column, std::string(name) + ": " + in_quotes(field.text) + " is not a number");
  }
  if (!std::isfinite(value)) place.refuse(field.column, std::string(name) + ": " + in_quotes(field.text) + " is not finite");
  return value;
}

Quat attitude(const std::array<double, 7>& values, const Field& first, const Place& place) {
  const Quat q(values[3], values[0], values[1], values[2]);
  const double length = q.norm();
  if (std::fabs(length - 1) > kQuaternionLengthTolerance) {
    place.refuse(first.column, "qx,qy,qz,qw: length " + std::to_string(length) + ", expected a quaternion of unit length");
  }
  return normalized(q);
}

InitialPose read_row(std::string_view line, const Place& place) {
  const std::vector<Field> fields = fields_of(line);
  if (fields.size() != kColumns.size()) {
    place.refuse(fields.back().column, std::to_string(fields.size()) + " fields, expected " + std::to_string(kColumns.size()));
  }
  if (fields[0].text.empty()) place.refuse(1, "scan: empty, expected the stem of a scan's file");
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = number(fields[i + 1], kColumns[i + 1], place);
  InitialPose result;
  result.scan = std::string(fields[0].text);
  result.T_sensor_target.q = attitude(values, fields[1], place);
  result.T_sensor_target.p = Vec3(values[4], values[5], values[6]);
  return result;
}

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool named(const std::vector<InitialPose>& poses, const std::string& scan) {
  return std::any_of(poses.begin(), poses.end(), [&](const InitialPose& pose) { return pose.scan == scan; });
}

}  // namespace

std::vector<InitialPose> read_initial_poses(const std::filesystem::path& file) {
  const std::string text = file_content(file);
  std::string_view rest = text;
  Place place{file.string(), 1};
  if (const std::string_view header = next_line(rest); header != kHeader) {
    place.refuse(1, in_quotes(header) + ", expected the header " + std::string(kHeader));
  }
  std::vector<InitialPose> poses;
  while (!rest.empty()) {
    ++place.line;
    const InitialPose pose = read_row(next_line(rest), place);
    if (named(poses, pose.scan)) place.refuse(1, "scan: " + in_quotes(pose.scan) + " has a row already");
    poses.push_back(pose);
  }
  if (poses.empty()) place.refuse(1, "no row follows the header");
  return poses;
}

const Pose& pose_of(const std::vector<InitialPose>& poses, const std::string& scan, const std::filesystem::path& file) {
  for (const InitialPose& pose : poses) {
    if (pose.scan == scan) return pose.T_sensor_target;
  }
  throw InputError(file.string() + ": no row for the scan '" + scan + "'");
}

}  // namespace lasso::mdat
