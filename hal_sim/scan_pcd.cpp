// Points of a PCD file (Point Cloud Library, version 0.6 or 0.7). Strict, as for PLY.
#include <algorithm>
#include <array>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

struct Field {
  std::string name;
  std::uint64_t bytes = 0;
  std::string type;
  std::uint64_t count = 1;
};

struct Header {
  std::vector<Field> fields;
  std::uint64_t width = 0, height = 1, points = 0;
  bool has_size = false, has_type = false, has_points = false;
  bool binary = false;
};

struct Coordinate {
  std::size_t word = 0;    // position among the values of a point
  std::size_t offset = 0;  // bytes from the begin of a point
  std::size_t bytes = 0;   // 0: there is no such field
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

void read_viewpoint(const Words& word, const std::string& place) {
  static constexpr double kIdentity[] = {0, 0, 0, 1, 0, 0, 0};
  bool identity = word.size() == 8;
  for (std::size_t i = 0; identity && i < 7; ++i) identity = number(word[i + 1], "VIEWPOINT", place) == kIdentity[i];
  if (!identity) fail(place, "expected \"VIEWPOINT 0 0 0 1 0 0 0\"; transform the points to the sensor's frame");
}

void read_data_kind(const Words& word, Header& header, const std::string& place) {
  const std::string_view kind = word.size() == 2 ? word[1] : std::string_view{};
  if (kind == "binary_compressed") fail(place, "DATA binary_compressed is not read; convert the file to binary or ascii");
  if (kind != "ascii" && kind != "binary") fail(place, "DATA is " + shown(kind) + ", expected ascii or binary");
  header.binary = kind == "binary";
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
  if (word[0] == "VIEWPOINT") return read_viewpoint(word, place);
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

// Appends a field to the layout of a point, noting where a coordinate stands.
void place_field(const Field& field, Layout& layout, const std::string& place) {
  const auto axis = std::find(kAxes.begin(), kAxes.end(), field.name);
  if (axis != kAxes.end()) {
    const bool real = field.type == "F" && (field.bytes == 4 || field.bytes == 8) && field.count == 1;
    if (!real) fail(place, "field " + shown(field.name) + " is not a single float or double (TYPE F, SIZE 4 or 8, COUNT 1)");
    Coordinate& coordinate = layout.xyz[static_cast<std::size_t>(axis - kAxes.begin())];
    if (coordinate.bytes != 0) fail(place, "field " + shown(field.name) + " is declared twice");
    coordinate = {layout.words, layout.bytes, static_cast<std::size_t>(field.bytes)};
  }
  layout.words += field.count;
  layout.bytes += field.bytes * field.count;
}

Layout layout_of(const Header& header, const std::string& place) {
  Layout layout;
  for (const Field& field : header.fields) place_field(field, layout, place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (layout.xyz[axis].bytes == 0) fail(place, "FIELDS has no " + shown(kAxes[axis]) + ", expected x y z");
  }
  return layout;
}

void read_ascii(Lines& lines, const Header& header, const Layout& layout, RangeImage& image) {
  std::string_view line;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (!lines.next(line))
      fail(lines.place(), "the file ends after " + std::to_string(i) + " of " + std::to_string(header.points) + " points");
    const auto word = words(line);
    if (word.size() != layout.words) {
      fail(lines.place(), "the point has " + std::to_string(word.size()) + " values, expected " + std::to_string(layout.words));
    }
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[static_cast<Eigen::Index>(axis)] = number(word[layout.xyz[axis].word], kAxes[axis], lines.place());
    }
    append_hit(image, point, 0, lines.place());
  }
}

// PCD's binary form is the memory of the machine that wrote it: little endian on every machine that the library runs on.
void read_binary(std::string_view data, const std::string& file, const Header& header, const Layout& layout, RangeImage& image) {
  if (data.size() < header.points * layout.bytes) {
    fail(file, "the file is truncated: " + std::to_string(data.size()) + " bytes follow the header, its " + std::to_string(header.points) +
                   " points need " + std::to_string(header.points * layout.bytes));
  }
  for (std::size_t i = 0; i < header.points; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Coordinate& at = layout.xyz[axis];
      point[static_cast<Eigen::Index>(axis)] = scalar_at(data.data() + i * layout.bytes + at.offset, at.bytes, false);
    }
    append_hit(image, point, 0, at_point(file, i + 1));
  }
}

}  // namespace

RangeImage read_pcd(const std::string& file, std::string_view text) {
  Lines lines(file, text);
  const Header header = read_header(lines);
  const Layout layout = layout_of(header, lines.place());
  RangeImage image;
  image.misses_known = false;
  if (header.binary) {
    read_binary(lines.rest(), file, header, layout, image);
  } else {
    read_ascii(lines, header, layout, image);
  }
  return image;
}

}  // namespace lasso::sim
