// The surfaces that a mission names: its target's, and those of the target's parts.
#include <Eigen/Geometry>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/modelc/cut.hpp"

namespace lasso::mdat {
namespace {

void warn_of_left_out(const std::filesystem::path& file, const std::vector<std::string>& left_out, std::vector<std::string>* warnings) {
  if (warnings == nullptr) return;
  for (const std::string& what : left_out) warnings->push_back(file.string() + ": not read: " + what);
}

}  // namespace

Mesh load_target(const MissionSource& source, std::vector<std::string>* warnings) {
  const TargetSource& target = source.target;
  try {
    std::vector<std::string> left_out;
    Mesh mesh = target.parametric ? build_model(target.file, target.parameters) : import_mesh(target.file, target.scale, &left_out);
    const double scale = target.parametric ? target.scale : 1;
    const Eigen::Vector3d origin_m(target.origin_m.data());
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = scale * vertex - origin_m;
    warn_of_left_out(target.file, left_out, warnings);
    check_extent(mesh);
    return mesh;
  } catch (const MeshError& error) {
    throw MissionError(problem_at(source, target.file_key, target.file.string(), error.what()));
  }
}

Mesh load_part(const MissionSource& source, const PartSource& part, const Mesh& target, std::vector<std::string>* warnings) {
  const Eigen::Quaterniond q(part.quaternion[3], part.quaternion[0], part.quaternion[1], part.quaternion[2]);
  const std::string key = "part." + part.name + (part.file.empty() ? ".box_m" : part.parametric ? ".model" : ".mesh");
  const auto fail = [&](const std::string& value, const std::string& why) { throw MissionError(problem_at(source, key, value, why)); };
  if (part.file.empty()) {
    Mesh mesh = cut_by_box(target, Eigen::Vector3d(part.box_m.data()), Eigen::Vector3d(part.box_m.data() + 3));
    if (mesh.triangles.empty())
      fail("", "nothing of the target lies in the box: the part has no model; correct the box, or delete the part");
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = q.conjugate() * (vertex - Eigen::Vector3d(part.origin_m.data()));
    return mesh;
  }
  try {
    std::vector<std::string> left_out;
    Mesh mesh = part.parametric ? build_model(part.file, {}) : import_mesh(part.file, part.scale, &left_out);
    const double scale = part.parametric ? part.scale : 1;
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= scale;
    warn_of_left_out(part.file, left_out, warnings);
    check_extent(mesh);
    return mesh;
  } catch (const MeshError& error) {
    fail(part.file.string(), std::string(error.what()) + "; give the part another file, or delete it");
  }
  return {};
}

}  // namespace lasso::mdat
