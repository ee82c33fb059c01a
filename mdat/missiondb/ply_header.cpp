#include "mdat/missiondb/ply_header.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"

namespace lasso::mdat {
namespace {

NumberType ply_type(const std::string& name) {
  static const std::map<std::string, NumberType> types{
      {"char", NumberType::kInt8},   {"int8", NumberType::kInt8},     {"uchar", NumberType::kUint8},   {"uint8", NumberType::kUint8},
      {"short", NumberType::kInt16}, {"int16", NumberType::kInt16},   {"ushort", NumberType::kUint16}, {"uint16", NumberType::kUint16},
      {"int", NumberType::kInt32},   {"int32", NumberType::kInt32},   {"uint", NumberType::kUint32},   {"uint32", NumberType::kUint32},
      {"float", NumberType::kFloat}, {"float32", NumberType::kFloat}, {"double", NumberType::kDouble}, {"float64", NumberType::kDouble}};
  const auto found = types.find(name);
  if (found == types.end()) throw MeshError("has a PLY header with an unknown type " + excerpt(name));
  return found->second;
}

[[noreturn]] void refuse_line(const std::string& line) {
  throw MeshError("has a PLY header with a line that is not understood: " + excerpt(line));
}

PlyProperty read_property(std::istringstream& words, const std::string& line) {
  std::string type, count;
  PlyProperty property;
  words >> type;
  if (type == "list") words >> count >> type;
  if (!(words >> property.name)) refuse_line(line);
  if (!count.empty()) property.count_type = ply_type(count);
  property.type = ply_type(type);
  return property;
}

PlyFormat read_format(std::istringstream& words, const std::string& line) {
  static const std::map<std::string, PlyFormat> formats{
      {"ascii", PlyFormat::kAscii}, {"binary_little_endian", PlyFormat::kLittle}, {"binary_big_endian", PlyFormat::kBig}};
  std::string name, version;
  words >> name >> version;
  const auto found = formats.find(name);
  if (found == formats.end() || version != "1.0") refuse_line(line);
  return found->second;
}

void read_header_line(const std::string& line, PlyHeader& header) {
  std::istringstream words(line);
  std::string keyword;
  if (!(words >> keyword) || keyword == "ply" || keyword == "comment" || keyword == "obj_info") return;
  if (keyword == "format") {
    header.format = read_format(words, line);
  } else if (keyword == "element") {
    PlyElement element;
    if (!(words >> element.name >> element.count)) refuse_line(line);
    header.elements.push_back(element);
  } else if (keyword == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(read_property(words, line));
  } else {
    refuse_line(line);
  }
}

bool has_number(const PlyElement& element, const std::string& name) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& property) { return !property.count_type && lower_case(property.name) == name; });
}

void check_element(const PlyElement& element) {
  if (element.properties.empty()) throw MeshError("has a PLY element without properties: " + excerpt(element.name));
  if (element.name == "vertex" && !(has_number(element, "x") && has_number(element, "y") && has_number(element, "z"))) {
    throw MeshError("has vertices without the properties x, y, z");
  }
  const bool faces = element.name == "face" || element.name == "tristrips";
  if (faces && std::none_of(element.properties.begin(), element.properties.end(), is_ply_corners)) {
    throw MeshError("has " + element.name + " without a list of vertex_index or vertex_indices");
  }
}

// Lines end as the first one does: with LF, CR LF, or CR alone, which a binary file's data could not be told from otherwise.
std::string_view line_end_of(std::string_view bytes) {
  const std::size_t end = bytes.find_first_of("\r\n");
  if (end == std::string_view::npos || bytes[end] == '\n') return "\n";
  return bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
}

}  // namespace

bool is_ply_corners(const PlyProperty& property) { return property.count_type && property.name.starts_with("vertex_ind"); }

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  const std::string_view line_end = line_end_of(bytes);
  std::size_t begin = 0;
  for (std::size_t end = bytes.find(line_end); end != std::string_view::npos; end = bytes.find(line_end, begin)) {
    std::string line(bytes.substr(begin, end - begin));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (begin == 0 && line != "ply") break;
    begin = header.end = end + line_end.size();
    ++header.lines;
    if (line != "end_header") {
      read_header_line(line, header);
      continue;
    }
    for (const PlyElement& element : header.elements) check_element(element);
    return header;
  }
  throw MeshError("is not a PLY file, or its header is truncated");
}

}  // namespace lasso::mdat
