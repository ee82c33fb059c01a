#include "mdat/serve/preview_answer.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/scene_surfaces.hpp"
#include "mdat/serve/answers.hpp"
#include "mdat/serve/problem_words.hpp"
#include "mdat/serve/scan_preview.hpp"
#include "mdat/source/mission_error.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat::serve {
namespace {

using PreviewJson = nlohmann::ordered_json;

template <class T>
std::string_view memory_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// The same as long as the surface is the same.
std::string surface_digest(const Mesh& mesh) {
  return sha256_of(std::string(memory_of(mesh.vertices)) + std::string(memory_of(mesh.triangles)));
}

PreviewJson rays_json(const ScanPreview& preview) {
  PreviewJson x = PreviewJson::array(), y = x, z = x, age_s = x, hit = x;
  for (const PreviewRay& ray : preview.rays) {
    x.push_back(static_cast<float>(ray.place_m.x()));
    y.push_back(static_cast<float>(ray.place_m.y()));
    z.push_back(static_cast<float>(ray.place_m.z()));
    age_s.push_back(static_cast<float>(ray.time_s));
    hit.push_back(ray.hit ? 1 : 0);
  }
  return {{"x", x}, {"y", y}, {"z", z}, {"age_s", age_s}, {"hit", hit}};
}

PreviewJson pose_json(const Pose& pose) {
  return {{"position_m", {pose.p.x(), pose.p.y(), pose.p.z()}}, {"quaternion_xyzw", {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()}}};
}

PreviewJson answer_of(const ScanPreview& preview, const Mesh& target) {
  const MissionParameters& p = preview.parameters;
  return {{"scenario", preview.scenario},
          {"run", preview.run},
          {"ranges_m", preview.ranges_m},
          {"sensor", preview.sensor},
          {"camera",
           {{"frustum_deg", {2 * p.fov_half_x_rad / kRadPerDeg, 2 * p.fov_half_y_rad / kRadPerDeg}},
            {"range_m", {p.range_min_m, p.range_max_m}}}},
          {"pose", pose_json(preview.T_sensor_target)},
          {"own", pose_json(preview.T_sensor_own)},
          {"size_m", preview.size_m},
          {"surface", surface_digest(target)},
          {"remark", preview.remark},
          {"rays", rays_json(preview)}};
}

PreviewJson preview_of(const LiveMission& mission, const std::string& text, const std::string& scenario, std::size_t run) {
  try {
    MissionSource source = load_mission_text(text, mission.file);
    const Mesh target = load_target(source);
    load_scene(source, target);
    if (source.scenarios.empty()) return {{"problem", "the mission has no scenario that says where the target is"}};
    const bool known = source.scenarios.count(scenario) > 0;
    return answer_of(preview_scan(source, target, known ? scenario : source.scenarios.begin()->first, run), target);
  } catch (const MissionError& error) {
    return {{"problem", problem_words(error.problems().front())}};
  } catch (const std::runtime_error& error) {
    return {{"problem", error.what()}};
  }
}

SurfaceTriangles triangles_of(const Mesh& mesh) {
  SurfaceTriangles surface;
  for (const Eigen::Vector3d& v : mesh.vertices)
    surface.points.push_back({static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  for (const auto& triangle : mesh.triangles) surface.indices.insert(surface.indices.end(), triangle.begin(), triangle.end());
  return surface;
}

}  // namespace

std::string preview_json(const LiveMission& mission, const std::string& text, const std::string& scenario, std::size_t run) {
  return preview_of(mission, text, scenario, run).dump(-1, ' ', false, PreviewJson::error_handler_t::replace);
}

Response mission_surface(const LiveMission& mission, const std::string& text) {
  try {
    return surface_answer(triangles_of(load_target(load_mission_text(text, mission.file))));
  } catch (const MissionError& error) {
    throw Refusal{422, error.what(), "mend what it says; mdat mission check says the same"};
  }
}

}  // namespace lasso::mdat::serve
