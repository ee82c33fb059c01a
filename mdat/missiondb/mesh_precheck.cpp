#include "mdat/missiondb/mesh_precheck.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/ply_precheck.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlTriangle = 50;
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kGlbChunkHeader = 8;

std::uint32_t little_endian_u32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[offset + i])} << (8 * i);
  return value;
}

std::size_t count_words(const std::string& text, const std::string& wanted) {
  std::istringstream stream(text);
  std::size_t n = 0;
  for (std::string word; stream >> word;) n += std::size_t{word == wanted};
  return n;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::size_t precheck_ascii_stl(std::string_view bytes) {
  const std::string text = lower_case(bytes);
  const std::size_t facets = count_words(text, "endfacet");
  const bool whole = count_words(text, "endsolid") > 0 && count_words(text, "vertex") == 3 * facets && count_words(text, "facet") == facets;
  if (!whole) throw MeshError("is a truncated or corrupt ASCII STL: facets or `endsolid` are incomplete");
  if (facets == 0) throw MeshError("is empty: it holds no triangle");
  return facets;
}

bool looks_ascii(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 512);
  const bool text = std::all_of(head.begin(), head.end(), [](unsigned char c) { return c >= 9 && c < 127; });
  return text && bytes.find("solid") < 80;
}

std::size_t precheck_stl(std::string_view bytes) {
  if (bytes.size() >= kStlHeader) {
    const std::size_t n = little_endian_u32(bytes, kStlHeader - 4);
    if (bytes.size() == kStlHeader + kStlTriangle * n) {
      if (n == 0) throw MeshError("is empty: it holds no triangle");
      return n;
    }
  }
  if (looks_ascii(bytes)) return precheck_ascii_stl(bytes);
  if (bytes.size() < kStlHeader)
    throw MeshError("is truncated: a binary STL has at least 84 bytes, this one " + std::to_string(bytes.size()));
  const std::size_t n = little_endian_u32(bytes, kStlHeader - 4);
  throw MeshError("is truncated or corrupt: its header announces " + std::to_string(n) + " triangles, that is " +
                  std::to_string(kStlHeader + kStlTriangle * n) + " bytes, but it has " + std::to_string(bytes.size()));
}

// Counts vertices and faces; an index past the vertices so far is a broken file.
std::size_t precheck_obj(std::string_view bytes) {
  std::istringstream stream{std::string(bytes)};
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) continue;
    vertices += std::size_t{word == "v"};
    if (word != "f") continue;
    ++faces;
    std::size_t corners = 0;
    for (; words >> word; ++corners) {
      if (std::strtoll(word.c_str(), nullptr, 10) > static_cast<long long>(vertices)) {
        throw MeshError("face " + std::to_string(faces) + " refers to vertex " + word + ", but there are " + std::to_string(vertices) +
                        " before it: the file is truncated or corrupt");
      }
    }
    if (corners < 3) throw MeshError("face " + std::to_string(faces) + " has fewer than 3 corners: the file is truncated or corrupt");
  }
  if (faces == 0) throw MeshError("is empty: it holds no face");
  return faces;
}

// Counts in a glTF's JSON that its buffers cannot hold: the mesh library would try them all.
std::size_t precheck_gltf(std::string_view text) {
  const nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  if (!root.is_object()) throw MeshError("is not a glTF file (its JSON is truncated or corrupt)");
  double bytes = 0;
  for (const auto& buffer : root.value("buffers", nlohmann::json::array()))
    bytes += buffer.is_object() ? buffer.value("byteLength", 0.0) : 0.0;
  for (const auto& accessor : root.value("accessors", nlohmann::json::array())) {
    const double count = accessor.is_object() ? accessor.value("count", -1.0) : -1.0;
    if (!(count >= 0 && count <= bytes)) throw MeshError("has a glTF accessor whose count does not fit its buffers: the file is corrupt");
  }
  return 1;
}

std::size_t precheck_glb(std::string_view bytes) {
  if (bytes.size() < kGlbHeader + kGlbChunkHeader || bytes.substr(0, 4) != "glTF")
    throw MeshError("is not a binary glTF file, or truncated");
  const std::size_t length = little_endian_u32(bytes, 8);
  const std::size_t text_length = little_endian_u32(bytes, kGlbHeader);
  if (length > bytes.size() || text_length > bytes.size() - kGlbHeader - kGlbChunkHeader) {
    throw MeshError("is truncated or corrupt: its header announces more than its " + std::to_string(bytes.size()) + " bytes");
  }
  return precheck_gltf(bytes.substr(kGlbHeader + kGlbChunkHeader, text_length));
}

}  // namespace

std::size_t precheck_mesh_file(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.empty()) throw MeshError("is empty: it has 0 bytes");
  const std::string kind = lower_case(file.extension().string());
  if (kind == ".stl") return precheck_stl(bytes);
  if (kind == ".ply") return precheck_ply(bytes);
  if (kind == ".obj") return precheck_obj(bytes);
  try {
    if (kind == ".glb") return precheck_glb(bytes);
    if (kind == ".gltf") return precheck_gltf(bytes);
  } catch (const nlohmann::json::exception&) {
    throw MeshError("is a corrupt glTF file: a value is of the wrong type");
  }
  throw MeshError("is of kind \"" + kind + "\", expected .stl, .obj, .ply, .gltf or .glb");
}

}  // namespace lasso::mdat
