#include "mdat/run/true_target.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

using Box = Eigen::AlignedBox3d;
using Triangle = std::array<std::uint32_t, 3>;

Box box_of(const std::vector<double>& corners_m) { return {Eigen::Vector3d(corners_m.data()), Eigen::Vector3d(corners_m.data() + 3)}; }
bool has_size(const Box& box) { return box.sizes().minCoeff() > 0; }

bool is_centred_in(const Mesh& mesh, const Triangle& t, const Box& box) {
  return box.contains(((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3).eval());
}

// Returns the same triangles; those of the part have vertices of their own, which are turned.
void turn_part(const Box& box, const Vec3& turn_rad, Mesh& mesh) {
  const Quat q = exp_so3(turn_rad);
  std::map<std::uint32_t, std::uint32_t> copies;
  const std::vector<Eigen::Vector3d> before = mesh.vertices;
  const Mesh model{before, mesh.triangles};
  for (Triangle& triangle : mesh.triangles) {
    if (!is_centred_in(model, triangle, box)) continue;
    for (std::uint32_t& vertex : triangle) {
      const auto [copy, is_new] = copies.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.emplace_back(box.center() + rotate(q, before[vertex] - box.center()));
      vertex = copy->second;
    }
  }
}

const std::vector<bool>& moved_triangles(const Scenario& scenario) {
  static const std::vector<bool> none;
  return scenario.scene == nullptr ? none : scenario.scene->surfaces->moved;
}

// Marks are taken before anything is turned: a part is where the model has it.
std::vector<bool> gone_triangles(const Mesh& model, const Scenario& scenario) {
  const Box box = box_of(scenario.model_gone_box_m);
  std::vector<bool> gone = moved_triangles(scenario);
  gone.resize(model.triangles.size(), false);
  for (std::size_t i = 0; has_size(box) && i < gone.size(); ++i) gone[i] = gone[i] || is_centred_in(model, model.triangles[i], box);
  return gone;
}

void remove_triangles(const std::vector<bool>& gone, Mesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
}

// Vertices of one place move together: many files (all STL) write a vertex once for each of its triangles, and the surface is not to tear.
void move_vertices(double sigma_m, std::uint64_t seed, Mesh& mesh) {
  constexpr std::uint64_t kStream = 0x766572746578U;  // not that of the noise
  sim::Random random(seed ^ kStream);
  std::map<std::array<double, 3>, Eigen::Vector3d> errors_m;
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    const auto [error_m, is_new] = errors_m.try_emplace({vertex.x(), vertex.y(), vertex.z()}, Eigen::Vector3d::Zero());
    for (int axis = 0; is_new && axis < 3; ++axis) error_m->second[axis] = sigma_m * random.gaussian();
    vertex += error_m->second;
  }
}

}  // namespace

bool has_model_error(const Scenario& scenario) {
  const bool turned = has_size(box_of(scenario.model_turned_box_m)) && !Vec3(scenario.model_turn_rad.data()).isZero();
  return turned || !moved_triangles(scenario).empty() || has_size(box_of(scenario.model_gone_box_m)) || scenario.model_scale != 1 ||
         scenario.model_vertex_sigma_m != 0;
}

Mesh true_target(const Mesh& model, const Scenario& scenario, std::uint64_t seed) {
  Mesh mesh = model;
  const std::vector<bool> gone = gone_triangles(model, scenario);
  const Box turned = box_of(scenario.model_turned_box_m);
  if (has_size(turned)) turn_part(turned, Vec3(scenario.model_turn_rad.data()), mesh);
  remove_triangles(gone, mesh);
  if (mesh.triangles.empty()) throw RunError("model_gone_box_m: nothing of the simulated target is left; make the box smaller");
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= scenario.model_scale;
  if (scenario.model_vertex_sigma_m > 0) move_vertices(scenario.model_vertex_sigma_m, seed, mesh);
  return mesh;
}

std::vector<std::uint32_t> kept_triangles(const Mesh& model, const Scenario& scenario) {
  const std::vector<bool> gone = gone_triangles(model, scenario);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) kept.push_back(i);
  }
  return kept;
}

std::unique_ptr<sim::RayCaster> make_target(const Mesh& mesh, const std::vector<sim::LaserReflection>& laser) {
  std::vector<Triangle> triangles;
  std::vector<sim::LaserReflection> reflections;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!((mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm() > 0)) continue;
    triangles.push_back(t);
    if (!laser.empty()) reflections.push_back(laser[i]);
  }
  return sim::make_ray_caster(mesh.vertices, triangles, reflections);
}

std::unique_ptr<sim::RayCaster> simulated_target(const Mesh& model, const Scenario& scenario, std::uint64_t seed,
                                                 const std::vector<sim::LaserReflection>& laser) {
  if (!has_model_error(scenario)) return make_target(model, laser);
  std::vector<sim::LaserReflection> kept;
  for (const std::uint32_t triangle : kept_triangles(model, scenario)) {
    if (!laser.empty()) kept.push_back(laser[triangle]);
  }
  return make_target(true_target(model, scenario, seed), kept);
}

}  // namespace lasso::mdat
