#include "mdat/missiondb/scene_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>

#include "mdat/missiondb/laser_material.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/point_discs.hpp"
#include "mdat/missiondb/target_parts.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

class SceneLoader {
 public:
  SceneLoader(MissionSource& source, const Mesh& target) : source_(source), target_(target) {}

  void load() {
    SceneSurfaces surfaces;
    for (const BodySource& body : source_.scene.bodies) {
      try {
        surfaces.bodies.push_back(body.file.empty() ? parts_of_target(body, surfaces.moved) : surface_of_file(body));
      } catch (const MissionError& error) {
        problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
      }
    }
    if (!problems_.empty()) throw MissionError(problems_);
    *source_.scene.surfaces = std::move(surfaces);
  }

 private:
  [[noreturn]] void refuse(const BodySource& body, const std::string& value, const std::string& why) const {
    throw MissionError(problem_at(source_, body.key, value, why));
  }

  static Mesh surface_of_points(const BodySource& body) {
    PointCloud cloud = read_cloud(body.file);
    for (Eigen::Vector3d& point : cloud.points) point *= body.scale;
    return disc_mesh(cloud, body.disc_radius_m);
  }

  BodySurface surface_of_file(const BodySource& body) const {
    try {
      BodySurface surface;
      std::vector<ModelSolid> solids;
      std::vector<std::string> left_out;
      surface.mesh = body.parametric          ? build_model(body.file, {}, &solids)
                     : body.disc_radius_m > 0 ? surface_of_points(body)
                                              : import_mesh(body.file, body.scale, &left_out);
      for (Eigen::Vector3d& vertex : surface.mesh.vertices) vertex *= body.parametric ? body.scale : 1;
      for (const std::string& what : left_out) source_.warnings.push_back(body.file.string() + ": not read: " + what);
      check_extent(surface.mesh);
      if (!body.parametric) solids.push_back({body.node, surface.mesh.triangles.size()});
      for (const ModelSolid& solid : solids) {
        surface.part_of_triangle.insert(surface.part_of_triangle.end(), solid.triangles, number_of_name(surface.part_names, solid.name));
      }
      return surface;
    } catch (const MeshError& error) {
      refuse(body, body.file.string(), error.what());
    }
  }

  const TargetParts& target_parts_once() {
    if (!parts_) parts_ = target_parts(source_, target_);
    return *parts_;
  }

  std::vector<bool> named_parts(const BodySource& body) {
    const std::vector<std::string>& names = target_parts_once().names;
    std::vector<bool> named(names.size(), false);
    for (const std::string& pattern : body.parts) {
      bool found = false;
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (!matches_part(names[i], pattern)) continue;
        named[i] = true;
        found = true;
      }
      if (!found)
        refuse(body, '"' + pattern + '"',
               "the target has no such part" + did_you_mean(pattern, names) + "; mdat render --as parts shows them");
    }
    return named;
  }

  bool stands_on_target(std::string node) const {
    const std::vector<scene::Node>& nodes = source_.scene.nodes;
    for (std::size_t i = 0; i <= nodes.size() && node != source_.scene.target && node != kSceneRoot; ++i) {
      node = std::find_if(nodes.begin(), nodes.end(), [&](const scene::Node& one) { return one.name == node; })->parent;
    }
    return node == source_.scene.target;
  }

  // Parts are seldom meant to stay behind.
  void warn_of_parent(const BodySource& body) {
    if (stands_on_target(body.node)) return;
    source_.warnings.push_back(to_string(
        problem_at(source_, body.key, "", "these parts do not move with the target: write parent = \"" + source_.scene.target + "\"")));
  }

  BodySurface parts_of_target(const BodySource& body, std::vector<bool>& moved) {
    const TargetParts& parts = target_parts_once();
    const std::vector<bool> named = named_parts(body);
    warn_of_parent(body);
    moved.resize(target_.triangles.size(), false);
    BodySurface surface{{target_.vertices, {}}, parts.names, {}, {}};
    for (std::size_t i = 0; i < target_.triangles.size(); ++i) {
      if (!named[parts.of_triangle[i]]) continue;
      if (moved[i]) refuse(body, '"' + parts.names[parts.of_triangle[i]] + '"', "the part is another node's already");
      moved[i] = true;
      surface.mesh.triangles.push_back(target_.triangles[i]);
      surface.part_of_triangle.push_back(parts.of_triangle[i]);
    }
    if (std::find(moved.begin(), moved.end(), false) == moved.end()) refuse(body, "", "nothing of the target is left at its own node");
    return surface;
  }

  MissionSource& source_;
  const Mesh& target_;
  std::optional<TargetParts> parts_;
  std::vector<Problem> problems_;
};

Problem material_problem(const MissionSource& source, const MaterialSource& material, const std::string& part, const std::string& why) {
  return problem_at(source, "material." + material.name + ".parts", '"' + part + '"', why);
}

// One pattern of a material; `of_part` gets what it matches.
void check_pattern(const MissionSource& source, const MaterialSource& material, const std::string& pattern,
                   const std::vector<std::string>& names, std::map<std::string, std::string>& of_part, std::vector<Problem>& problems) {
  bool found = false;
  for (const std::string& name : names) {
    if (!matches_part(name, pattern)) continue;
    found = true;
    const auto [of, is_new] = of_part.emplace(name, material.name);
    if (!is_new) problems.push_back(material_problem(source, material, pattern, name + " is of [material." + of->second + "] already"));
  }
  if (!found)
    problems.push_back(material_problem(source, material, pattern,
                                        "there is no such part" + did_you_mean(pattern, names) + "; mdat render --as parts shows them"));
}

void check_materials(const MissionSource& source, const std::vector<std::string>& names) {
  std::vector<Problem> problems;
  std::map<std::string, std::string> of_part;
  for (const MaterialSource& material : source.materials) {
    for (const std::string& pattern : material.parts) check_pattern(source, material, pattern, names, of_part, problems);
  }
  if (!problems.empty()) throw MissionError(problems);
}

// Parts of other bodies by their names as [material.NAME] has them.
void set_laser_reflections(MissionSource& source, const Mesh& target) {
  const TargetParts parts = target_parts(source, target);
  source.target_laser = laser_reflections(source, parts.names, parts.of_triangle);
  std::vector<std::string> names = parts.names;
  for (std::size_t i = 0; i < source.scene.bodies.size(); ++i) {
    BodySurface& surface = source.scene.surfaces->bodies[i];
    std::vector<std::uint32_t> numbers = part_numbers_of(source.scene.bodies[i], surface, names);
    for (const std::uint32_t part : surface.part_of_triangle) surface.laser.push_back(laser_reflection(source, names[numbers[part]]));
  }
}

}  // namespace

std::vector<std::uint32_t> part_numbers_of(const BodySource& body, const BodySurface& surface, std::vector<std::string>& names) {
  std::vector<std::uint32_t> numbers;
  for (const std::string& part : surface.part_names) {
    const bool alone = body.file.empty() || part == body.node;
    numbers.push_back(number_of_name(names, alone ? part : body.node + "." + part));
  }
  return numbers;
}

std::vector<std::string> part_names_of(const MissionSource& source, const Mesh& target) {
  std::vector<std::string> names = target_parts(source, target).names;
  for (std::size_t i = 0; i < source.scene.bodies.size(); ++i)
    static_cast<void>(part_numbers_of(source.scene.bodies[i], source.scene.surfaces->bodies[i], names));
  return names;
}

void load_scene(MissionSource& source, const Mesh& target) {
  if (!source.scene.bodies.empty()) SceneLoader(source, target).load();
  if (!source.materials.empty()) check_materials(source, part_names_of(source, target));
  if (has_detector(source)) set_laser_reflections(source, target);
}

}  // namespace lasso::mdat
