// Points of a PLY file. Strict: what is not understood is refused, as a wrong guess would move every point.
#include <array>
#include <optional>
#include <utility>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Property {
  std::string name;
  ScalarType type;
  ScalarType count;  // of a list, how its length is written; bytes 0: no list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  // Bytes of one of them; nothing where a list makes them differ.
  std::optional<std::size_t> bytes() const {
    std::size_t sum = 0;
    for (const Property& property : properties) {
      if (property.count.bytes != 0) return std::nullopt;
      sum += property.type.bytes;
    }
    return sum;
  }
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;  // up to the vertices, the last
  bool complete = false;          // those after the vertices are not looked at
};

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

using Words = std::vector<std::string_view>;

ScalarType type_of(std::string_view name, const std::string& place) {
  using Kind = ScalarType::Kind;
  static constexpr std::pair<std::string_view, ScalarType> kTypes[] = {
      {"char", {Kind::kSigned, 1}},  {"uchar", {Kind::kUnsigned, 1}},  {"short", {Kind::kSigned, 2}}, {"ushort", {Kind::kUnsigned, 2}},
      {"int", {Kind::kSigned, 4}},   {"uint", {Kind::kUnsigned, 4}},   {"float", {Kind::kReal, 4}},   {"double", {Kind::kReal, 8}},
      {"int8", {Kind::kSigned, 1}},  {"uint8", {Kind::kUnsigned, 1}},  {"int16", {Kind::kSigned, 2}}, {"uint16", {Kind::kUnsigned, 2}},
      {"int32", {Kind::kSigned, 4}}, {"uint32", {Kind::kUnsigned, 4}}, {"float32", {Kind::kReal, 4}}, {"float64", {Kind::kReal, 8}}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  fail(place, "property type " + shown(name) + " is not known, expected char, uchar, short, ushort, int, uint, float or double");
}

void read_format(const Words& word, Header& header, const std::string& place) {
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

void read_element(const Words& word, Header& header, const std::string& place) {
  if (word.size() != 3) fail(place, "expected \"element NAME COUNT\"");
  header.complete = header.complete || (!header.elements.empty() && header.elements.back().name == "vertex");
  if (header.complete) return;
  const bool vertex = word[1] == "vertex";
  header.elements.push_back({std::string(word[1]), count(word[2], vertex ? "the number of vertices" : "the element's count", place), {}});
  if (vertex) check_point_count(header.elements.back().count, place);
}

void read_property(const Words& word, Header& header, const std::string& place) {
  if (header.elements.empty()) fail(place, "a property before the first element");
  if (header.complete) return;
  const bool list = word.size() == 5 && word[1] == "list";
  if (!list && word.size() != 3) fail(place, "expected \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
  Property property{std::string(word.back()), type_of(word[list ? 3 : 1], place), {}};
  if (list) property.count = type_of(word[2], place);
  if (list && property.count.kind == ScalarType::Kind::kReal)
    fail(place, "the length of a list is of type " + shown(word[2]) + ", expected an integer");
  header.elements.back().properties.push_back(property);
}

// Which properties of a vertex are its coordinates.
std::array<std::size_t, 3> coordinates_of(const Element& vertex, const std::string& place) {
  std::array<std::size_t, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
      if (vertex.properties[i].name != kAxes[axis] || vertex.properties[i].count.bytes != 0) continue;
      xyz[axis] = i;
      ++found;
    }
    if (found == 0) fail(place, "the vertex has no property " + shown(kAxes[axis]) + ", expected x, y, z");
    if (found > 1) fail(place, "coordinate " + shown(kAxes[axis]) + " is declared twice");
  }
  return xyz;
}

void read_declaration(const Words& word, Header& header, const std::string& place) {
  if (word[0] == "element") return read_element(word, header, place);
  if (word[0] == "property") return read_property(word, header, place);
  fail(place, "header keyword " + shown(word[0]) + " is not known");
}

void check_vertices_declared(const Header& header, const std::string& place) {
  if (header.elements.empty() || header.elements.back().name != "vertex") fail(place, "the header declares no element \"vertex\"");
}

Header read_header(Lines& lines) {
  std::string_view line;
  if (!lines.next(line) || trimmed(line) != "ply") fail(at_line(lines.file(), 1), "expected \"ply\": not a PLY file");
  Header header;
  if (!lines.next(line)) fail(lines.place(), "the header ends after its first line");
  bool format_known = false;
  do {
    const auto word = words(line);
    if (word.empty() || word[0] == "comment" || word[0] == "obj_info") continue;
    if (format_known && word[0] == "end_header") {
      check_vertices_declared(header, lines.place());
      return header;
    }
    format_known ? read_declaration(word, header, lines.place()) : read_format(word, header, lines.place());
    format_known = true;
  } while (lines.next(line));
  fail(lines.place(), "the header has no \"end_header\"");
}

// The words of a line by the element's properties: of a list its length. Throws where they are not as many as declared.
Words by_property(const Element& element, const Words& word, const std::string& place) {
  Words found;
  std::size_t at = 0;
  for (const Property& property : element.properties) {
    if (at >= word.size()) break;
    found.push_back(word[at]);
    at += 1;
    if (property.count.bytes != 0) at += count(found.back(), property.name, place);
  }
  if (found.size() == element.properties.size() && at == word.size()) return found;
  const bool lists = !element.bytes();
  fail(place, "the point has " + std::to_string(word.size()) + " values, expected " +
                  (lists ? "as many as its properties and lists" : std::to_string(element.properties.size())));
}

class AsciiReader {
 public:
  explicit AsciiReader(Lines& lines) : lines_(lines) {}

  void pass_over(const Element& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) static_cast<void>(next(element, i));
  }

  // `last`: no element follows the vertices.
  void read(const Element& vertex, bool last, const std::array<std::size_t, 3>& xyz, RawScan& scan) {
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      const Words line = next(vertex, i);
      const Words value = by_property(vertex, line, lines_.place());
      Vec3 point = Vec3::Zero();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[static_cast<Eigen::Index>(axis)] = any_number(value[xyz[axis]], kAxes[axis], lines_.place());
      }
      scan.add_point(point, 0, lines_.number());
    }
    if (last) check_end(lines_, vertex.count);
  }

 private:
  // The next line that is not blank.
  Words next(const Element& element, std::uint64_t done) {
    std::string_view line;
    while (lines_.next(line)) {
      Words word = words(line);
      if (!word.empty()) return word;
    }
    const std::string what = element.name == "vertex" ? " points" : " of element " + shown(element.name);
    fail(lines_.place(), "the file ends after " + std::to_string(done) + " of " + std::to_string(element.count) + what);
  }

  Lines& lines_;
};

class BinaryReader {
 public:
  BinaryReader(std::string_view data, std::string file, bool big_endian) : data_(data), file_(std::move(file)), big_endian_(big_endian) {}

  void pass_over(const Element& element) {
    if (const auto bytes = element.bytes()) {
      need(element, element.count, *bytes);
      at_ += element.count * *bytes;
      return;
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) static_cast<void>(next(property));
    }
  }

  void read(const Element& vertex, bool /*last*/, const std::array<std::size_t, 3>& xyz, RawScan& scan) {
    if (const auto bytes = vertex.bytes()) need(vertex, vertex.count, *bytes);
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      Vec3 point = Vec3::Zero();
      for (std::size_t k = 0; k < vertex.properties.size(); ++k) {
        const double value = next(vertex.properties[k]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (xyz[axis] == k) point[static_cast<Eigen::Index>(axis)] = value;
        }
      }
      scan.add_point(point, 0, i + 1);
    }
  }

 private:
  void need(const Element& element, std::uint64_t count, std::size_t bytes) const {
    const std::size_t left = data_.size() - at_;
    if (bytes == 0 || count <= left / bytes) return;
    fail(file_, "the file is truncated: " + std::to_string(left) + " bytes are left for the " + std::to_string(count) + " of element " +
                    shown(element.name) + ", which need " + std::to_string(count * bytes));
  }

  // The value of a property, of a list its length.
  double next(const Property& property) {
    const ScalarType first = property.count.bytes != 0 ? property.count : property.type;
    const double value = scalar_at(take(first.bytes), first, big_endian_);
    if (property.count.bytes == 0) return value;
    const double items = value < 0 ? 0 : value;
    if (items > static_cast<double>(data_.size())) static_cast<void>(take(data_.size() + 1));
    static_cast<void>(take(static_cast<std::size_t>(items) * property.type.bytes));
    return value;
  }

  const char* take(std::size_t bytes) {
    if (bytes > data_.size() - at_) fail(file_, "the file is truncated: it ends within an element");
    const char* const begin = data_.data() + at_;
    at_ += bytes;
    return begin;
  }

  std::string_view data_;
  std::size_t at_ = 0;
  std::string file_;
  bool big_endian_;
};

template <class Reader>
void read_points(Reader reader, const Header& header, const std::array<std::size_t, 3>& xyz, RawScan& scan) {
  for (std::size_t i = 0; i + 1 < header.elements.size(); ++i) reader.pass_over(header.elements[i]);
  reader.read(header.elements.back(), !header.complete, xyz, scan);
}

}  // namespace

RawScan read_ply(const std::string& file, std::string_view text) {
  Lines lines(file, text);
  const Header header = read_header(lines);
  const auto xyz = coordinates_of(header.elements.back(), lines.place());
  RawScan scan;
  scan.file = file;
  scan.rows_are_lines = header.encoding == Encoding::kAscii;
  if (header.encoding == Encoding::kAscii) {
    read_points(AsciiReader(lines), header, xyz, scan);
  } else {
    read_points(BinaryReader(lines.rest(), file, header.encoding == Encoding::kBigEndian), header, xyz, scan);
  }
  return scan;
}

}  // namespace lasso::sim
