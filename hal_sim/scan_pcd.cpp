// Points of a PCD file (Point Cloud Library, version 0.5 to 0.7). Strict, as for PLY.
//
// VIEWPOINT is where the sensor stood, tx ty tz qw qx qy qz, in the axes of the points: the pose that takes the sensor's coordinates to
// those.
#include <algorithm>
#include <array>
#include <cmath>

#include "hal_sim/lzf.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

struct Field {
  std::string name;
  std::uint64_t bytes = 0;
  std::string type;
  std::uint64_t count = 1;
};

enum class Encoding { kAscii, kBinary, kCompressed };

struct Header {
  std::vector<Field> fields;
  std::uint64_t width = 0, height = 1, points = 0;
  bool has_size = false, has_type = false, has_points = false;
  Encoding encoding = Encoding::kAscii;
  Pose T_file_sensor;
};

struct Coordinate {
  std::size_t word = 0;    // position among the values of a point
  std::size_t offset = 0;  // bytes from the begin of a point
  ScalarType type;         // no bytes: there is no such field
};

struct Layout {
  std::size_t words = 0, bytes = 0;  // of a point
  std::array<Coordinate, 3> xyz;
};

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
constexpr std::uint64_t kLargestCount = 4096;  // values of one field: keeps sizes far from overflow

using Words = std::vector<std::string_view>;

void check_one_a_field(const Words& word, const Header& header, const std::string& place) {
  if (header.fields.empty()) fail(place, std::string(word[0]) + " before FIELDS");
  if (word.size() == header.fields.size() + 1) return;
  fail(place, std::string(word[0]) + " has " + std::to_string(word.size() - 1) + " values, expected one for each of the " +
                  std::to_string(header.fields.size()) + " FIELDS");
}

void read_sizes(const Words& word, Header& header, const std::string& place) {
  check_one_a_field(word, header, place);
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::uint64_t bytes = count(word[i + 1], "SIZE", place);
    if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8) fail(place, "SIZE is " + shown(word[i + 1]) + ", expected 1, 2, 4 or 8");
    header.fields[i].bytes = bytes;
  }
  header.has_size = true;
}

void read_types(const Words& word, Header& header, const std::string& place) {
  check_one_a_field(word, header, place);
  for (std::size_t i = 0; i < header.fields.size(); ++i) header.fields[i].type = word[i + 1];
  header.has_type = true;
}

void read_counts(const Words& word, Header& header, const std::string& place) {
  check_one_a_field(word, header, place);
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    header.fields[i].count = count(word[i + 1], "COUNT", place);
    if (header.fields[i].count > kLargestCount) fail(place, "COUNT is " + shown(word[i + 1]) + ", expected at most 4096");
  }
}

void read_viewpoint(const Words& word, Header& header, const std::string& place) {
  constexpr double kUnitTolerance = 1e-3;
  if (word.size() != 8) fail(place, "VIEWPOINT has " + std::to_string(word.size() - 1) + " values, expected 7: tx ty tz qw qx qy qz");
  double value[7];
  for (std::size_t i = 0; i < 7; ++i) value[i] = number(word[i + 1], "VIEWPOINT", place);
  const Quat q(value[3], value[4], value[5], value[6]);
  if (std::abs(q.norm() - 1) > kUnitTolerance)
    fail(place, "VIEWPOINT has a quaternion (the last four) of length " + text_of(q.norm()) + ", expected 1");
  header.T_file_sensor = {normalized(q), Vec3(value[0], value[1], value[2])};
}

void read_data_kind(const Words& word, Header& header, const std::string& place) {
  const std::string_view kind = word.size() == 2 ? word[1] : std::string_view{};
  if (kind == "ascii") {
    header.encoding = Encoding::kAscii;
  } else if (kind == "binary") {
    header.encoding = Encoding::kBinary;
  } else if (kind == "binary_compressed") {
    header.encoding = Encoding::kCompressed;
  } else {
    fail(place, "DATA is " + shown(kind) + ", expected ascii, binary or binary_compressed");
  }
}

std::uint64_t single_count(const Words& word, const std::string& place) {
  if (word.size() != 2) fail(place, std::string(word[0]) + " has " + std::to_string(word.size() - 1) + " values, expected 1");
  return count(word[1], word[0], place);
}

void read_points(const Words& word, Header& header, const std::string& place) {
  header.points = single_count(word, place);
  header.has_points = true;
  check_point_count(header.points, place);
}

void read_fields(const Words& word, Header& header, const std::string& place) {
  if (!header.fields.empty()) fail(place, "FIELDS is declared twice");
  for (std::size_t i = 1; i < word.size(); ++i) header.fields.push_back({std::string(word[i]), 0, {}, 1});
}

void read_entry(const Words& word, Header& header, const std::string& place) {
  if (word[0] == "VERSION") return;
  if (word[0] == "FIELDS") return read_fields(word, header, place);
  if (word[0] == "SIZE") return read_sizes(word, header, place);
  if (word[0] == "TYPE") return read_types(word, header, place);
  if (word[0] == "COUNT") return read_counts(word, header, place);
  if (word[0] == "VIEWPOINT") return read_viewpoint(word, header, place);
  if (word[0] == "POINTS") return read_points(word, header, place);
  if (word[0] == "WIDTH") {
    header.width = single_count(word, place);
  } else if (word[0] == "HEIGHT") {
    header.height = single_count(word, place);
  } else {
    fail(place, "header entry " + shown(word[0]) + " is not known: not a PCD file");
  }
}

void check_complete(const Header& header, const std::string& place) {
  if (!header.has_size || !header.has_type || !header.has_points) fail(place, "the header lacks FIELDS, SIZE, TYPE or POINTS");
  const bool product = header.height != 0 && header.points % header.height == 0 && header.points / header.height == header.width;
  if (!product) fail(place, "POINTS is " + std::to_string(header.points) + ", expected WIDTH times HEIGHT");
}

Header read_header(Lines& lines) {
  Header header;
  std::string_view line;
  while (lines.next(line)) {
    const auto word = words(line);
    if (word.empty() || word[0].front() == '#') continue;
    if (word[0] != "DATA") {
      read_entry(word, header, lines.place());
      continue;
    }
    read_data_kind(word, header, lines.place());
    check_complete(header, lines.place());
    return header;
  }
  fail(lines.number() == 0 ? at_line(lines.file(), 1) : lines.place(), "the header has no DATA: not a PCD file, or truncated");
}

ScalarType coordinate_type(const Field& field, const std::string& place) {
  using Kind = ScalarType::Kind;
  const bool real = field.type == "F" && field.bytes >= 4;
  const bool whole = field.type == "I" || field.type == "U";
  if (field.count != 1 || !(real || whole)) {
    fail(place, "field " + shown(field.name) + " is not a single number (TYPE F with SIZE 4 or 8, I or U, COUNT 1)");
  }
  return {real ? Kind::kReal : field.type == "I" ? Kind::kSigned : Kind::kUnsigned, static_cast<std::size_t>(field.bytes)};
}

// Appends a field to the layout of a point, noting where a coordinate stands.
void place_field(const Field& field, Layout& layout, const std::string& place) {
  const auto axis = std::find(kAxes.begin(), kAxes.end(), field.name);
  if (axis != kAxes.end()) {
    Coordinate& coordinate = layout.xyz[static_cast<std::size_t>(axis - kAxes.begin())];
    if (coordinate.type.bytes != 0) fail(place, "field " + shown(field.name) + " is declared twice");
    coordinate = {layout.words, layout.bytes, coordinate_type(field, place)};
  }
  layout.words += field.count;
  layout.bytes += field.bytes * field.count;
}

Layout layout_of(const Header& header, const std::string& place) {
  Layout layout;
  for (const Field& field : header.fields) place_field(field, layout, place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (layout.xyz[axis].type.bytes == 0) fail(place, "FIELDS has no " + shown(kAxes[axis]) + ", expected x y z");
  }
  return layout;
}

// Blank lines are passed over.
Words next_words(Lines& lines, std::uint64_t done, std::uint64_t points) {
  std::string_view line;
  while (lines.next(line)) {
    Words word = words(line);
    if (!word.empty()) return word;
  }
  fail(lines.place(), "the file ends after " + std::to_string(done) + " of " + std::to_string(points) + " points");
}

void read_ascii(Lines& lines, const Header& header, const Layout& layout, RawScan& scan) {
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const Words word = next_words(lines, i, header.points);
    if (word.size() != layout.words) {
      fail(lines.place(), "the point has " + std::to_string(word.size()) + " values, expected " + std::to_string(layout.words));
    }
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[static_cast<Eigen::Index>(axis)] = any_number(word[layout.xyz[axis].word], kAxes[axis], lines.place());
    }
    scan.add_point(point, 0, lines.number());
  }
  check_end(lines, header.points);
}

void check_size(std::size_t have, const Header& header, const Layout& layout, const std::string& file) {
  if (have / layout.bytes >= header.points) return;
  fail(file, "the file is truncated: " + std::to_string(have) + " bytes of data, its " + std::to_string(header.points) + " points need " +
                 std::to_string(header.points * layout.bytes));
}

// PCD's binary forms are the memory of the machine that wrote them: little endian on every machine that the library runs on. A point's
// fields are beside each other in the plain one; in the compressed one all values of a field are.
void read_binary(std::string_view data, const Header& header, const Layout& layout, RawScan& scan) {
  check_size(data.size(), header, layout, scan.file);
  const bool by_field = header.encoding == Encoding::kCompressed;
  for (std::size_t i = 0; i < header.points; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Coordinate& at = layout.xyz[axis];
      const std::size_t offset = by_field ? at.offset * header.points + i * at.type.bytes : i * layout.bytes + at.offset;
      point[static_cast<Eigen::Index>(axis)] = scalar_at(data.data() + offset, at.type, false);
    }
    scan.add_point(point, 0, i + 1);
  }
}

// Two lengths, packed and not, and what is packed by LZF.
std::string unpacked(std::string_view data, const Header& header, const Layout& layout, const std::string& file) {
  constexpr ScalarType kLength{ScalarType::Kind::kUnsigned, 4};
  constexpr std::size_t kLengths = 8;
  if (data.size() < kLengths) fail(file, "the file is truncated: it ends before its compressed data");
  const auto packed = static_cast<std::size_t>(scalar_at(&data[0], kLength, false));
  const auto size = static_cast<std::size_t>(scalar_at(&data[4], kLength, false));
  if (packed > data.size() - kLengths) {
    fail(file, "the file is truncated: " + std::to_string(data.size() - kLengths) + " of " + std::to_string(packed) +
                   " bytes of compressed data");
  }
  check_size(size, header, layout, file);
  std::string bytes;
  if (!unpack_lzf(data.substr(kLengths, packed), size, bytes))
    fail(file, "the compressed data cannot be unpacked; write the file anew, as binary or ascii");
  return bytes;
}

}  // namespace

RawScan read_pcd(const std::string& file, std::string_view text) {
  Lines lines(file, text);
  const Header header = read_header(lines);
  const Layout layout = layout_of(header, lines.place());
  RawScan scan;
  scan.file = file;
  scan.rows_are_lines = header.encoding == Encoding::kAscii;
  scan.T_file_sensor = header.T_file_sensor;
  if (header.encoding == Encoding::kAscii) {
    read_ascii(lines, header, layout, scan);
  } else if (header.encoding == Encoding::kBinary) {
    read_binary(lines.rest(), header, layout, scan);
  } else {
    read_binary(unpacked(lines.rest(), header, layout, file), header, layout, scan);
  }
  return scan;
}

}  // namespace lasso::sim
