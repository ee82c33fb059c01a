#include <cmath>

#include "mdat/missiondb/file_mesh.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"
#include "mdat/missiondb/ply_header.hpp"
#include "mdat/missiondb/point_discs.hpp"

namespace lasso::mdat {
namespace {

// The data, value by value, as text or binary. Throws MeshError at their end.
class PlyValues {
 public:
  PlyValues(std::string_view bytes, const PlyHeader& header)
      : words_(bytes.substr(header.end), header.lines + 1), bytes_(bytes.substr(header.end)), format_(header.format) {}

  double next(NumberType type) {
    if (format_ == PlyFormat::kAscii) return words_.number();
    if (size_of(type) > bytes_.size()) throw MeshError("is truncated: its data end before what its header announces");
    const double value = raw_number(type, &bytes_[0], format_ == PlyFormat::kBig ? std::endian::big : std::endian::little);
    bytes_.remove_prefix(size_of(type));
    return value;
  }
  // A binary file may have more; text that has more is out of step, and what was read of it wrong.
  std::size_t left() {
    if (format_ != PlyFormat::kAscii) return bytes_.size();
    if (!words_.next().empty()) words_.refuse("there are more values than the header announces");
    return 0;
  }

 private:
  Words words_;
  std::string_view bytes_;
  PlyFormat format_;
};

class PlyReader {
 public:
  explicit PlyReader(std::string_view bytes) : header_(read_ply_header(bytes)), values_(bytes, header_) {}

  FileMesh read() {
    for (const PlyElement& element : header_.elements) read_element(element);
    std::size_t flat = 0;
    for (const std::vector<std::uint32_t>& corners : faces_) {
      if (corners.size() < 3) {
        ++flat;
      } else {
        add_polygon(mesh_, corners);
      }
    }
    if (flat > 0) mesh_.left_out.push_back(count_text(flat, "face") + " of fewer than 3 corners");
    for (const std::vector<double>& strips : strips_) add_strips(strips);
    if (mesh_.triangles.empty()) throw MeshError("is empty: it holds no face (points alone are a scan, not a target)");
    const std::size_t left = values_.left();
    if (left > 0) mesh_.left_out.push_back(count_text(left, "byte") + " behind what its header announces");
    return std::move(mesh_);
  }

  PointCloud read_points() {
    for (const PlyElement& element : header_.elements) read_element(element);
    if (mesh_.vertices.empty()) throw MeshError("is empty: it holds no point");
    if (mesh_.vertices.size() > kMaxCloudPoints)
      throw MeshError("holds " + std::to_string(mesh_.vertices.size()) + " points: expected at most " + std::to_string(kMaxCloudPoints) +
                      "; thin it out");
    PointCloud cloud{mesh_.vertices, {}};
    for (std::size_t i = 0; has_normals() && i < normals_.size(); ++i) cloud.normals.push_back(unit_normal(i));
    for (const Eigen::Vector3d& point : cloud.points) {
      if (!point.allFinite()) throw MeshError("has a point that is not finite");
    }
    return cloud;
  }

 private:
  bool has_normals() const {
    std::size_t found = 0;
    for (const PlyElement& element : header_.elements) {
      for (const PlyProperty& property : element.properties) {
        const std::string name = lower_case(property.name);
        if (element.name == "vertex" && (name == "nx" || name == "ny" || name == "nz")) ++found;
      }
    }
    return found == 3;
  }
  Eigen::Vector3d unit_normal(std::size_t point) const {
    const double length = normals_[point].norm();
    if (!(length > 0 && std::isfinite(length))) throw MeshError("has a normal without a direction, of point " + std::to_string(point));
    return normals_[point] / length;
  }
  void read_element(const PlyElement& element) {
    if (element.name == "vertex" && !mesh_.vertices.empty()) throw MeshError("has two lists of vertices");
    if (element.name == "edge" && element.count > 0) mesh_.left_out.push_back(count_text(element.count, "edge"));
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        read_vertex(element);
      } else {
        read_lists(element);
      }
    }
  }
  void read_vertex(const PlyElement& element) {
    Eigen::Vector3d vertex = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : element.properties) {
      if (property.count_type) {
        static_cast<void>(read_list(property));
        continue;
      }
      const double value = values_.next(property.type);
      const std::string name = lower_case(property.name);
      if (name.size() == 1 && name >= "x" && name <= "z") vertex[name[0] - 'x'] = value;
      if (name.size() == 2 && name >= "nx" && name <= "nz") normal[name[1] - 'x'] = value;
    }
    mesh_.vertices.push_back(vertex);
    normals_.push_back(normal);
  }
  void read_lists(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!property.count_type) {
        static_cast<void>(values_.next(property.type));
        continue;
      }
      const std::vector<double> list = read_list(property);
      if (is_ply_corners(property) && element.name == "face") faces_.push_back(indices_of(list));
      if (is_ply_corners(property) && element.name == "tristrips") strips_.push_back(list);
    }
  }
  std::vector<double> read_list(const PlyProperty& property) {
    const double count = values_.next(property.count_type.value_or(NumberType::kUint8));
    if (!(count >= 0 && count == std::floor(count))) throw MeshError("has a list of " + std::to_string(count) + " values");
    std::vector<double> list;  // grows as far as there are data
    while (static_cast<double>(list.size()) < count) list.push_back(values_.next(property.type));
    return list;
  }
  static std::uint32_t index_of(double value) {
    constexpr double kMost = 0xFFFFFFFF;
    if (!(value >= 0 && value <= kMost && value == std::floor(value)))
      throw MeshError("has a face that refers to a vertex that is not there");
    return static_cast<std::uint32_t>(value);
  }
  static std::vector<std::uint32_t> indices_of(const std::vector<double>& list) {
    std::vector<std::uint32_t> indices;
    for (const double value : list) indices.push_back(index_of(value));
    return indices;
  }
  // Strips one after the other, with -1 behind each.
  void add_strips(const std::vector<double>& list) {
    std::vector<std::uint32_t> strip;
    for (const double value : list) {
      if (value != -1) {
        strip.push_back(index_of(value));
        continue;
      }
      add_strip(mesh_, strip);
      strip.clear();
    }
    add_strip(mesh_, strip);
  }

  PlyHeader header_;
  PlyValues values_;
  FileMesh mesh_;
  std::vector<Eigen::Vector3d> normals_;           // of the vertices; zero: none is written
  std::vector<std::vector<std::uint32_t>> faces_;  // they may stand before the vertices
  std::vector<std::vector<double>> strips_;
};

}  // namespace

FileMesh read_ply(std::string_view bytes) { return PlyReader(plain_text(bytes)).read(); }

PointCloud read_ply_points(std::string_view bytes) { return PlyReader(plain_text(bytes)).read_points(); }

}  // namespace lasso::mdat
