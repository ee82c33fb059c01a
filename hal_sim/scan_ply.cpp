// Points of a PLY file. Strict: what is not understood is refused, as a wrong guess would move every point.
#include <array>
#include <utility>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::uint64_t points = 0;
  bool has_vertex = false;
  bool in_vertex = false;        // the properties that follow are the vertex's
  std::size_t properties = 0;    // of a vertex
  std::size_t vertex_bytes = 0;  // in the binary forms
  struct Coordinate {
    std::size_t property = 0, offset = 0, bytes = 0;  // bytes 0: not declared
  };
  std::array<Coordinate, 3> xyz;
};

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

std::size_t bytes_of(std::string_view type, const std::string& place) {
  static constexpr std::pair<std::string_view, std::size_t> kTypes[] = {
      {"char", 1}, {"uchar", 1}, {"short", 2}, {"ushort", 2}, {"int", 4},   {"uint", 4},   {"float", 4},   {"double", 8},
      {"int8", 1}, {"uint8", 1}, {"int16", 2}, {"uint16", 2}, {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};
  for (const auto& [name, bytes] : kTypes) {
    if (name == type) return bytes;
  }
  fail(place, "property type " + shown(type) + " is not known, expected char, uchar, short, ushort, int, uint, float or double");
}

bool is_real(std::string_view type) { return type == "float" || type == "double" || type == "float32" || type == "float64"; }

void read_format(const std::vector<std::string_view>& word, Header& header, const std::string& place) {
  const bool complete = word.size() == 3 && word[0] == "format" && word[2] == "1.0";
  if (complete && word[1] == "ascii") {
    header.encoding = Encoding::kAscii;
  } else if (complete && word[1] == "binary_little_endian") {
    header.encoding = Encoding::kLittleEndian;
  } else if (complete && word[1] == "binary_big_endian") {
    header.encoding = Encoding::kBigEndian;
  } else {
    fail(place, "expected \"format ascii 1.0\", \"format binary_little_endian 1.0\" or \"format binary_big_endian 1.0\"");
  }
}

void read_element(const std::vector<std::string_view>& word, Header& header, const std::string& place) {
  if (word.size() != 3) fail(place, "expected \"element NAME COUNT\"");
  header.in_vertex = word[1] == "vertex" && !header.has_vertex;
  if (!header.has_vertex && !header.in_vertex)
    fail(place, "the first element is " + shown(word[1]) + ", expected \"vertex\"; write the points first");
  if (!header.in_vertex) return;
  header.has_vertex = true;
  header.points = count(word[2], "the number of vertices", place);
  check_point_count(header.points, place);
}

void read_property(const std::vector<std::string_view>& word, Header& header, const std::string& place) {
  if (!header.has_vertex) fail(place, "a property before the first element");
  if (!header.in_vertex) return;
  if (word.size() != 3) fail(place, "expected \"property TYPE NAME\"; lists in a vertex are not read");
  const std::size_t bytes = bytes_of(word[1], place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (word[2] != kAxes[axis]) continue;
    if (!is_real(word[1])) fail(place, "coordinate " + shown(word[2]) + " is of type " + shown(word[1]) + ", expected float or double");
    if (header.xyz[axis].bytes != 0) fail(place, "coordinate " + shown(word[2]) + " is declared twice");
    header.xyz[axis] = {header.properties, header.vertex_bytes, bytes};
  }
  header.properties += 1;
  header.vertex_bytes += bytes;
}

void check_complete(const Header& header, const std::string& place) {
  if (!header.has_vertex) fail(place, "the header declares no element \"vertex\"");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (header.xyz[axis].bytes == 0) fail(place, "the vertex has no property " + shown(kAxes[axis]) + ", expected float or double x, y, z");
  }
}

Header read_header(Lines& lines) {
  std::string_view line;
  if (!lines.next(line) || line != "ply") fail(at_line(lines.file(), 1), "expected \"ply\": not a PLY file");
  Header header;
  if (!lines.next(line)) fail(lines.place(), "the header ends after its first line");
  read_format(words(line), header, lines.place());
  while (lines.next(line)) {
    const auto word = words(line);
    if (word.empty() || word[0] == "comment" || word[0] == "obj_info") continue;
    if (word[0] == "end_header") {
      check_complete(header, lines.place());
      return header;
    }
    if (word[0] == "element") {
      read_element(word, header, lines.place());
    } else if (word[0] == "property") {
      read_property(word, header, lines.place());
    } else {
      fail(lines.place(), "header keyword " + shown(word[0]) + " is not known");
    }
  }
  fail(lines.place(), "the header has no \"end_header\"");
}

void read_ascii(Lines& lines, const Header& header, RangeImage& image) {
  std::string_view line;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const bool there = lines.next(line);
    const auto word = words(there ? line : std::string_view{});
    if (!there) fail(lines.place(), "the file ends after " + std::to_string(i) + " of " + std::to_string(header.points) + " points");
    if (word.size() != header.properties) {
      fail(lines.place(), "the point has " + std::to_string(word.size()) + " values, expected " + std::to_string(header.properties));
    }
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[static_cast<Eigen::Index>(axis)] = number(word[header.xyz[axis].property], kAxes[axis], lines.place());
    }
    append_hit(image, point, 0, lines.place());
  }
}

void read_binary(std::string_view data, const std::string& file, const Header& header, RangeImage& image) {
  if (data.size() < header.points * header.vertex_bytes) {
    fail(file, "the file is truncated: " + std::to_string(data.size()) + " bytes follow the header, its " + std::to_string(header.points) +
                   " points need " + std::to_string(header.points * header.vertex_bytes));
  }
  for (std::size_t i = 0; i < header.points; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& at = header.xyz[axis];
      const char* const bytes = data.data() + i * header.vertex_bytes + at.offset;
      point[static_cast<Eigen::Index>(axis)] = scalar_at(bytes, at.bytes, header.encoding == Encoding::kBigEndian);
    }
    append_hit(image, point, 0, at_point(file, i + 1));
  }
}

}  // namespace

RangeImage read_ply(const std::string& file, std::string_view text) {
  Lines lines(file, text);
  const Header header = read_header(lines);
  RangeImage image;
  image.misses_known = false;
  if (header.encoding == Encoding::kAscii) {
    read_ascii(lines, header, image);
  } else {
    read_binary(lines.rest(), file, header, image);
  }
  return image;
}

}  // namespace lasso::sim
