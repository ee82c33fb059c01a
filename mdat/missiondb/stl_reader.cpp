#include <cstring>

#include "mdat/missiondb/file_mesh.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"
#include "mdat/missiondb/raw_number.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlTriangle = 50;

// The keywords of the text, in any case and however they stand in lines. What stands behind `solid` and `endsolid` is a name of any words,
// and what stands between `facet` and `outer` is the normal, which nobody reads.
class StlText {
 public:
  explicit StlText(std::string_view text) : words_(text) {}

  FileMesh read() {
    std::size_t begun = 0, ended = 0;
    for (std::string word = keyword(); !word.empty(); word = keyword()) {
      if (word == "facet") {
        read_facet();
        continue;
      }
      if (word != "solid" && word != "endsolid") words_.refuse("expected `facet` or `endsolid`, found " + excerpt(word));
      begun += std::size_t{word == "solid"};
      ended += std::size_t{word == "endsolid"};
      words_.rest_of_line();
    }
    if (ended == 0 || ended < begun) words_.refuse("`endsolid` is missing: the file is truncated or corrupt");
    if (mesh_.triangles.empty()) throw MeshError("is empty: it holds no triangle");
    return std::move(mesh_);
  }

 private:
  std::string keyword() { return lower_case(words_.next()); }
  void expect(const char* wanted) {
    const std::string word = keyword();
    if (word != wanted)
      words_.refuse(std::string("expected `") + wanted + "`, found " + excerpt(word) + ": the file is truncated or corrupt");
  }
  void read_facet() {
    std::string word = keyword();
    while (word != "outer") {
      if (word.empty() || word == "facet" || word == "vertex" || word == "endfacet") {
        words_.refuse("a facet has no `outer loop`: the file is truncated or corrupt");
      }
      word = keyword();
    }
    expect("loop");
    std::vector<std::uint32_t> corners;
    for (word = keyword(); word == "vertex"; word = keyword()) corners.push_back(read_vertex());
    if (word != "endloop") words_.refuse("expected `vertex` or `endloop`, found " + excerpt(word) + ": the file is truncated or corrupt");
    expect("endfacet");
    if (corners.size() < 3) words_.refuse("a facet has " + std::to_string(corners.size()) + " vertices, expected 3");
    add_polygon(mesh_, corners);
  }
  std::uint32_t read_vertex() {
    const double x = words_.number();
    const double y = words_.number();
    mesh_.vertices.emplace_back(x, y, words_.number());
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  Words words_;
  FileMesh mesh_;
};

// A binary file's header may begin with `solid`, too; but its count of triangles has a NUL byte, if they are fewer than 16 million.
bool is_stl_text(std::string_view bytes) {
  const std::string word = lower_case(Words(plain_text(bytes.substr(0, 1000))).next());
  return (word == "solid" || word == "facet") && bytes.substr(0, kStlHeader).find('\0') == std::string_view::npos;
}

[[noreturn]] void refuse_binary(std::string_view bytes, std::size_t triangles) {
  const std::string_view head = bytes.substr(0, kStlHeader);
  if (head.find_first_not_of("\t\r\n") != std::string_view::npos && head.find('\0') == std::string_view::npos) {
    throw MeshError("is neither a text STL, which begins with `solid`, nor a whole binary one: it begins with " + excerpt(head));
  }
  if (bytes.size() < kStlHeader)
    throw MeshError("is truncated: a binary STL has at least 84 bytes, this one " + std::to_string(bytes.size()));
  throw MeshError("is truncated or corrupt: its header announces " + std::to_string(triangles) + " triangles, that is " +
                  std::to_string(kStlHeader + kStlTriangle * triangles) + " bytes, but it has " + std::to_string(bytes.size()));
}

FileMesh read_binary_stl(std::string_view bytes) {
  const std::size_t triangles = bytes.size() < kStlHeader ? 0 : static_cast<std::size_t>(raw_number(NumberType::kUint32, &bytes[80]));
  const std::size_t size = kStlHeader + kStlTriangle * triangles;
  if (bytes.size() < size) refuse_binary(bytes, triangles);
  if (triangles == 0) {
    throw MeshError(
        "is empty: it holds no triangle" +
        (bytes.size() == size ? "" : ", says its header, but " + count_text(bytes.size() - size, "byte") + " follow: export it again"));
  }
  FileMesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const char* const corners = &bytes[kStlHeader + kStlTriangle * i + 12];  // behind the normal
    for (std::size_t k = 0; k < 9; k += 3) {
      const auto value = [&](std::size_t axis) { return raw_number(NumberType::kFloat, corners + 4 * (k + axis)); };
      mesh.vertices.emplace_back(value(0), value(1), value(2));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  if (bytes.size() > size) {
    mesh.left_out.push_back(count_text(bytes.size() - size, "byte") + " behind the " + std::to_string(triangles) +
                            " triangles that its header announces");
  }
  return mesh;
}

}  // namespace

FileMesh read_stl(std::string_view bytes) {
  const std::size_t announced = bytes.size() < kStlHeader ? 0 : static_cast<std::size_t>(raw_number(NumberType::kUint32, &bytes[80]));
  const bool whole_binary = announced > 0 && bytes.size() == kStlHeader + kStlTriangle * announced;
  return !whole_binary && is_stl_text(bytes) ? StlText(plain_text(bytes)).read() : read_binary_stl(bytes);
}

}  // namespace lasso::mdat
