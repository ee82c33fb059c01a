// Bytes that claim to be a mesh: STL, OBJ, PLY, glTF as text or binary, by the first byte modulo 5. The reader refuses them with one short
// line, or gives triangles of finite vertices that are there.
#include <algorithm>
#include <filesystem>
#include <string>

#include "ft/fuzz/exact.hpp"
#include "mdat/missiondb/mesh_import.hpp"

namespace lasso::fuzz {
namespace {

constexpr std::size_t kLongestLine = 300;
constexpr const char* kNames[] = {"mesh.stl", "mesh.obj", "mesh.ply", "mesh.gltf", "mesh.glb"};

bool is_short_line(const std::string& text) {
  const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
  return text.size() <= kLongestLine && std::all_of(text.begin(), text.end(), printable);
}

void check(const mdat::Mesh& mesh, const std::vector<std::string>& left_out) {
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      expect(corner < mesh.vertices.size(), "corners are vertices");
      used[corner] = true;
    }
  }
  expect(std::find(used.begin(), used.end(), false) == used.end(), "each vertex is of a triangle");
  expect(!mesh.triangles.empty(), "a mesh that is read has triangles");
  for (const Eigen::Vector3d& vertex : mesh.vertices) expect(vertex.allFinite(), "vertices are finite");
  for (const std::string& text : left_out) expect(is_short_line(text), "what is left out is told in one short line");
}

// Buffers beside a glTF are looked for in a folder that is not there.
void read(std::uint8_t kind, ConstBytes input) {
  const std::filesystem::path file = std::filesystem::path("no_such_folder") / kNames[kind % std::size(kNames)];
  ExactCopy text(input);
  std::vector<std::string> left_out;
  try {
    check(mdat::parse_mesh(file, {reinterpret_cast<const char*>(text.bytes().data()), input.size()}, 1, &left_out), left_out);
  } catch (const mdat::MeshError& error) {
    expect(is_short_line(error.what()), "a refusal is one short line");
  }
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::read(data[0], {data + 1, size - 1});
  return 0;
}
