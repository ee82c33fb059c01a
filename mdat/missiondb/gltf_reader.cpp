#include "mdat/missiondb/gltf_reader.hpp"

#include <Eigen/Geometry>

#include "mdat/missiondb/gltf_file.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::uint32_t kNotAdded = 0xFFFFFFFF;
constexpr std::size_t kMaxDepth = 200;  // of nodes in nodes
// A small file may place a mesh many times, and read its positions as often. Corners, and by them vertices, are bounded by the triangles.
constexpr std::size_t kMaxTriangles = 10'000'000;
constexpr std::size_t kMaxPositions = 100'000'000;

// The list of `count` numbers, or the preset where there is none.
std::vector<double> number_list(const GltfJson& object, const char* name, std::vector<double> preset) {
  if (!object.contains(name)) return preset;
  const GltfJson& list = gltf_list(object, name);
  std::vector<double> numbers;
  for (const GltfJson& number : list) numbers.push_back(number.is_number() ? number.get<double>() : std::nan(""));
  if (numbers.size() != preset.size())
    throw MeshError(std::string("is a corrupt glTF file: \"") + name + "\" has " + count_text(numbers.size(), "number"));
  return numbers;
}

Eigen::Affine3d transform_of(const GltfJson& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {  // column by column
    const std::vector<double> m = number_list(node, "matrix", std::vector<double>(16));
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    return transform;
  }
  const std::vector<double> t = number_list(node, "translation", {0, 0, 0});
  const std::vector<double> q = number_list(node, "rotation", {0, 0, 0, 1});
  const std::vector<double> s = number_list(node, "scale", {1, 1, 1});
  transform.translate(Eigen::Vector3d(t.data()));
  transform.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
  transform.scale(Eigen::Vector3d(s.data()));
  return transform;
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& folder, std::string_view bytes) : file_(folder, bytes) {}

  FileMesh read() {
    for (const std::size_t node : roots()) add_node(node, Eigen::Affine3d::Identity(), 0);
    if (mesh_.triangles.empty()) {
      throw MeshError("is empty: it holds no triangle" + std::string(lines_ > 0 ? ", but lines or points: export triangles" : ""));
    }
    if (lines_ > 0) mesh_.left_out.push_back(count_text(lines_, "primitive") + " of lines or points");
    if (posed_ > 0)
      mesh_.left_out.push_back("the bones or morphs of " + count_text(posed_, "node") + ": the mesh is read as it is without them");
    for (const std::string& name : file_.extensions_not_read()) mesh_.left_out.push_back("the glTF extension " + excerpt(name));
    return std::move(mesh_);
  }

 private:
  // Of the default scene, or of the first; without scenes the nodes that are in no other.
  std::vector<std::size_t> roots() {
    const GltfJson& root = file_.root();
    const std::size_t scenes = gltf_list(root, "scenes").size();
    if (scenes > 1) mesh_.left_out.push_back(count_text(scenes - 1, "further scene"));
    if (scenes > 0) return indices(gltf_entry(root, "scenes", gltf_index(root, "scene", 0)), "nodes");
    std::vector<bool> inner(gltf_list(root, "nodes").size());
    for (std::size_t node = 0; node < inner.size(); ++node) {
      for (const std::size_t child : indices(gltf_entry(root, "nodes", node), "children")) {
        if (child < inner.size()) inner[child] = true;
      }
    }
    std::vector<std::size_t> outer;
    for (std::size_t node = 0; node < inner.size(); ++node) {
      if (!inner[node]) outer.push_back(node);
    }
    return outer;
  }
  static std::vector<std::size_t> indices(const GltfJson& object, const char* name) {
    std::vector<std::size_t> list;
    for (const GltfJson& entry : gltf_list(object, name)) list.push_back(gltf_index(entry, name));
    return list;
  }
  void add_node(std::size_t index, const Eigen::Affine3d& T_root_parent, std::size_t depth) {
    visited_.resize(gltf_list(file_.root(), "nodes").size());
    const GltfJson& node = gltf_entry(file_.root(), "nodes", index);
    if (visited_[index] || depth > kMaxDepth) throw MeshError("is a corrupt glTF file: a node is in itself, or in two others");
    visited_[index] = true;
    const Eigen::Affine3d T_root_node = T_root_parent * transform_of(node);
    if (node.contains("mesh")) add_mesh(gltf_entry(file_.root(), "meshes", gltf_index(node, "mesh", 0)), node, T_root_node);
    for (const std::size_t child : indices(node, "children")) add_node(child, T_root_node, depth + 1);
  }
  void add_mesh(const GltfJson& mesh, const GltfJson& node, const Eigen::Affine3d& T_root_node) {
    posed_ += std::size_t{node.contains("skin") || node.contains("weights") || mesh.contains("weights")};
    for (const GltfJson& primitive : gltf_list(mesh, "primitives")) {
      if (!primitive.is_object()) throw MeshError("is a corrupt glTF file: a primitive is no object");
      add_primitive(primitive, T_root_node);
    }
  }
  void add_primitive(const GltfJson& primitive, const Eigen::Affine3d& T_root_node) {
    const std::size_t mode = gltf_index(primitive, "mode", 4);
    if (mode > 6) throw MeshError("is a corrupt glTF file: a primitive has the unknown mode " + std::to_string(mode));
    if (mode < 4) {
      ++lines_;
      return;
    }
    const auto attributes = primitive.find("attributes");
    const std::size_t positions =
        attributes == primitive.end() || !attributes->is_object() ? kNone : gltf_index(*attributes, "POSITION", kNone);
    if (positions == kNone) throw MeshError("has a glTF primitive without positions");
    read_positions(positions);
    add_corners(mode, corners_of(primitive, T_root_node), T_root_node.linear().determinant() < 0);
  }
  // Once for primitives that follow each other and share them, as they often do.
  void read_positions(std::size_t accessor) {
    if (accessor == positions_read_) return;
    numbers_ = file_.numbers(accessor, 3);
    positions_read_ = accessor;
    added_.assign(numbers_.size() / 3, kNotAdded);
    positions_ += added_.size();
    if (positions_ > kMaxPositions)
      throw MeshError("has more than " + std::to_string(kMaxPositions) + " positions, copies counted: export fewer copies");
  }
  // Of the primitive's positions those that it uses become vertices.
  std::vector<std::uint32_t> corners_of(const GltfJson& primitive, const Eigen::Affine3d& T_root_node) {
    const std::vector<std::size_t> indices = indices_of(primitive, added_.size());
    std::vector<std::uint32_t> corners;
    for (const std::size_t index : indices) {
      if (added_[index] == kNotAdded) {
        added_[index] = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(T_root_node * Eigen::Vector3d(&numbers_[3 * index]));
      }
      corners.push_back(added_[index]);
    }
    for (const std::size_t index : indices) added_[index] = kNotAdded;  // these alone: a primitive may use few of many positions
    return corners;
  }
  std::vector<std::size_t> indices_of(const GltfJson& primitive, std::size_t count) const {
    std::vector<std::size_t> indices;
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < count; ++i) indices.push_back(i);
      return indices;
    }
    for (const double index : file_.numbers(gltf_index(primitive, "indices", 0), 1)) {
      if (!(index >= 0 && index < static_cast<double>(count))) throw MeshError("has a face that refers to a vertex that is not there");
      indices.push_back(static_cast<std::size_t>(index));
    }
    return indices;
  }
  // A mirrored node turns its triangles round.
  void add_corners(std::size_t mode, const std::vector<std::uint32_t>& corners, bool mirrored) {
    const std::size_t first = mesh_.triangles.size();
    if (mode == 4 && corners.size() % 3 != 0)
      throw MeshError("has triangles of " + std::to_string(corners.size()) + " corners, no multiple of 3");
    triangles_ += mode == 4 ? corners.size() / 3 : corners.size();
    if (triangles_ > kMaxTriangles) {
      throw MeshError("has more than " + std::to_string(kMaxTriangles) +
                      " triangles, copies counted: export fewer copies or a coarser mesh");
    }
    for (std::size_t i = 0; mode == 4 && i + 2 < corners.size(); i += 3)
      mesh_.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    if (mode == 5) add_strip(mesh_, corners);
    for (std::size_t i = 1; mode == 6 && i + 1 < corners.size(); ++i) mesh_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
    for (std::size_t i = first; mirrored && i < mesh_.triangles.size(); ++i) std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
  }

  GltfFile file_;
  FileMesh mesh_;
  std::vector<bool> visited_;
  std::size_t positions_read_ = kNone;  // the accessor of numbers_
  std::vector<double> numbers_;
  std::vector<std::uint32_t> added_;           // of each of these positions, the vertex that the primitive has made of it
  std::size_t positions_ = 0, triangles_ = 0;  // read, and placed, copies counted
  std::size_t lines_ = 0, posed_ = 0;
};

}  // namespace

FileMesh read_gltf(const std::filesystem::path& folder, std::string_view bytes) { return GltfReader(folder, bytes).read(); }

}  // namespace lasso::mdat
