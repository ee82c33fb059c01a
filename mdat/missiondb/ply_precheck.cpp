#include "mdat/missiondb/ply_precheck.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "mdat/missiondb/mesh_import.hpp"

namespace lasso::mdat {
namespace {

struct Property {
  std::string name;
  std::size_t count_size = 0;  // bytes of a list's length; 0: a single value
  std::size_t value_size = 0;
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};
enum class Format { kAscii, kLittle, kBig };
struct Header {
  Format format = Format::kAscii;
  std::vector<Element> elements;
  std::size_t end = 0;  // first byte of the data
};

std::size_t size_of_type(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{
      {"char", 1}, {"uchar", 1}, {"int8", 1},  {"uint8", 1},  {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
      {"int", 4},  {"uint", 4},  {"int32", 4}, {"uint32", 4}, {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  if (found == sizes.end()) throw MeshError("has a PLY header with an unknown type \"" + type + '"');
  return found->second;
}

[[noreturn]] void refuse(const std::string& line) {
  throw MeshError("has a PLY header with a line that is not understood: \"" + line + '"');
}

Property read_property(std::istringstream& words, const std::string& line) {
  std::string type, count;
  Property property;
  words >> type;
  if (type == "list") words >> count >> type;
  if (!(words >> property.name)) refuse(line);
  if (!count.empty()) property.count_size = size_of_type(count);
  property.value_size = size_of_type(type);
  return property;
}

Format read_format(std::istringstream& words, const std::string& line) {
  static const std::map<std::string, Format> formats{
      {"ascii", Format::kAscii}, {"binary_little_endian", Format::kLittle}, {"binary_big_endian", Format::kBig}};
  std::string name, version;
  words >> name >> version;
  const auto found = formats.find(name);
  if (found == formats.end() || version != "1.0") refuse(line);
  return found->second;
}

void read_line(const std::string& line, Header& header) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "ply" || keyword == "comment" || keyword == "obj_info") return;
  if (keyword == "format") {
    header.format = read_format(words, line);
  } else if (keyword == "element") {
    Element element;
    if (!(words >> element.name >> element.count)) refuse(line);
    header.elements.push_back(element);
  } else if (keyword == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(read_property(words, line));
  } else {
    refuse(line);
  }
}

// The mesh library is strict about none of this: it searches on for ever, or reads past the end.
Header read_header(std::string_view bytes) {
  Header header;
  std::size_t begin = 0;
  for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; begin = end + 1, end = bytes.find('\n', begin)) {
    std::string line(bytes.substr(begin, end - begin));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (begin == 0 && line != "ply") break;
    header.end = end + 1;
    if (line == "end_header") return header;
    read_line(line, header);
  }
  throw MeshError("is not a PLY file, or its header is truncated");
}

bool has_property(const Element& element, const std::string& name, bool list) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const Property& property) { return property.name == name && (property.count_size > 0) == list; });
}

void check_properties(const Element& element) {
  if (element.properties.empty()) throw MeshError("has a PLY element without properties: \"" + element.name + '"');
  if (element.name == "vertex" &&
      !(has_property(element, "x", false) && has_property(element, "y", false) && has_property(element, "z", false))) {
    throw MeshError("has vertices without the properties x, y, z");
  }
  if (element.name == "face" && !has_property(element, "vertex_index", true) && !has_property(element, "vertex_indices", true)) {
    throw MeshError("has faces without a list of vertex_index or vertex_indices");
  }
}

// Walks through the data, value by value.
class Data {
 public:
  Data(std::string_view bytes, Format format) : bytes_(bytes), format_(format) {}

  // False at the end of the data.
  bool skip(std::size_t values, std::size_t value_size) {
    if (format_ == Format::kAscii) {
      for (std::size_t i = 0; i < values; ++i) {
        if (next_word().empty()) return false;
      }
      return true;
    }
    if (values > (bytes_.size() - position_) / value_size) return false;
    position_ += values * value_size;
    return true;
  }
  bool read_count(std::size_t size, std::size_t& count) {
    count = 0;
    if (format_ == Format::kAscii) {
      const std::string word(next_word());
      count = static_cast<std::size_t>(std::strtoull(word.c_str(), nullptr, 10));
      return !word.empty();
    }
    if (size > bytes_.size() - position_) return false;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t shift = 8 * (format_ == Format::kBig ? size - 1 - i : i);
      count |= std::size_t{static_cast<unsigned char>(bytes_[position_ + i])} << shift;
    }
    position_ += size;
    return true;
  }

 private:
  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t begin = bytes_.find_first_not_of(kSpace, position_);
    if (begin == std::string_view::npos) return {};
    position_ = std::min(bytes_.find_first_of(kSpace, begin), bytes_.size());
    return bytes_.substr(begin, position_ - begin);
  }
  std::string_view bytes_;
  Format format_;
  std::size_t position_ = 0;
};

bool skip_element(const Element& element, Data& data) {
  for (const Property& property : element.properties) {
    std::size_t values = 1;
    if (property.count_size > 0 && !data.read_count(property.count_size, values)) return false;
    if (!data.skip(values, property.value_size)) return false;
  }
  return true;
}

}  // namespace

std::size_t precheck_ply(std::string_view bytes) {
  const Header header = read_header(bytes);
  Data data(bytes.substr(header.end), header.format);
  std::size_t faces = 0;
  for (const Element& element : header.elements) {
    check_properties(element);
    if (element.name == "face") faces = element.count;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (skip_element(element, data)) continue;
      throw MeshError("is truncated: its header announces " + std::to_string(element.count) + " of \"" + element.name +
                      "\", the data end at " + std::to_string(i));
    }
  }
  if (faces == 0) throw MeshError("is empty: it holds no face (points alone are a scan, not a target)");
  return faces;
}

}  // namespace lasso::mdat
