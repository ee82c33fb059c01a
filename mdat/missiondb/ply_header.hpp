// What a PLY file says of its data before they begin. Inside of missiondb.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/missiondb/raw_number.hpp"

namespace lasso::mdat {

struct PlyProperty {
  std::string name;
  std::optional<NumberType> count_type;  // of a list
  NumberType type = NumberType::kFloat;
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};
enum class PlyFormat { kAscii, kLittle, kBig };
struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t end = 0;    // first byte of the data
  std::size_t lines = 0;  // before the data
};

// Throws MeshError: not PLY, truncated, a line that is not understood, vertices without x, y, z or faces without indices.
PlyHeader read_ply_header(std::string_view bytes);

// Whether this is the list of corners of a face or of strips: vertex_index, vertex_indices.
bool is_ply_corners(const PlyProperty& property);

}  // namespace lasso::mdat
