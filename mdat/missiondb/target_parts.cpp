#include "mdat/missiondb/target_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mdat/missiondb/model_file.hpp"

namespace lasso::mdat {
namespace {

TargetParts parts_by_solids(const TargetSource& target) {
  std::vector<ModelSolid> solids;
  static_cast<void>(build_model(target.file, target.parameters, &solids));
  TargetParts parts;
  for (const ModelSolid& solid : solids) {
    parts.of_triangle.insert(parts.of_triangle.end(), solid.triangles, number_of_name(parts.names, solid.name));
  }
  return parts;
}

std::string name_by_box(const MissionSource& source, const Eigen::Vector3d& center_m) {
  for (const PartSource& part : source.parts) {
    if (part.box_m.empty()) continue;
    if (Eigen::AlignedBox3d(Eigen::Vector3d(part.box_m.data()), Eigen::Vector3d(part.box_m.data() + 3)).contains(center_m))
      return part.name;
  }
  return "target";
}

}  // namespace

std::uint32_t number_of_name(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::uint32_t>(found - names.begin());
  names.push_back(name);
  return static_cast<std::uint32_t>(names.size() - 1);
}

bool matches_part(const std::string& part, const std::string& pattern) {
  if (pattern.empty() || pattern.back() != '*') return part == pattern;
  return part.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

TargetParts target_parts(const MissionSource& source, const Mesh& mesh) {
  if (source.target.parametric) return parts_by_solids(source.target);
  TargetParts parts;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d center_m = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    parts.of_triangle.push_back(number_of_name(parts.names, name_by_box(source, center_m)));
  }
  return parts;
}

}  // namespace lasso::mdat
