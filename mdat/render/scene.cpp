#include "mdat/render/scene.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>

#include "mdat/common/errors.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/missiondb/scene_surfaces.hpp"
#include "mdat/missiondb/target_parts.hpp"
#include "mdat/run/ranged_scene.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::size_t range_index(const Scenario& scenario, const std::string& name, const std::optional<double>& range_m) {
  if (!range_m) return 0;
  if (scenario.has_profile()) throw InputError("--range: scenario " + name + " flies through a profile of ranges: --time says where it is");
  const std::vector<double> ranges_m = scenario.runs_m();
  const auto found = std::find(ranges_m.begin(), ranges_m.end(), *range_m);
  if (found != ranges_m.end()) return static_cast<std::size_t>(found - ranges_m.begin());
  std::vector<std::string> names;
  for (const double range : ranges_m) names.push_back(format("%g", range));
  throw InputError(format("--range %g: scenario ", *range_m) + name + " has the ranges " + list_of(names) + " m");
}

// Of a camera: the node at which it stands, or none where that is the sensor frame.
struct FieldOfView {
  std::string name;
  double half_x_rad = 0, half_y_rad = 0;
  std::string node;
};

FieldOfView view_of(const std::string& name, const SensorParameters& sensor, const std::string& node) {
  return {name, sensor.fov_half_x_rad, sensor.fov_half_y_rad, node};
}

// All sensors, then the nodes with cameras.
std::vector<FieldOfView> cameras_of(const MissionSource& source) {
  const std::vector<std::string> names = sensor_names(source);
  std::vector<FieldOfView> cameras{view_of(names[0], source.parameters, "")};
  for (const FurtherSensor& sensor : source.further_sensors) cameras.push_back(view_of(sensor.name, sensor.parameters, sensor.node));
  for (const CameraSource& camera : source.scene.cameras)
    cameras.push_back({camera.node, camera.fov_half_x_rad, camera.fov_half_y_rad, camera.node});
  return cameras;
}

[[noreturn]] void refuse_camera(const std::string& asked, const std::vector<FieldOfView>& cameras) {
  std::vector<std::string> names;
  for (const FieldOfView& camera : cameras) names.push_back(camera.name);
  throw InputError("--camera " + asked + ": the mission's sensors and cameras are " + list_of(names) + did_you_mean(asked, names));
}

FieldOfView camera_of_mission(const MissionSource& source, const std::string& asked, double range_m) {
  const std::vector<FieldOfView> cameras = cameras_of(source);
  if (!asked.empty()) {
    const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const FieldOfView& camera) { return camera.name == asked; });
    if (found == cameras.end()) refuse_camera(asked, cameras);
    return *found;
  }
  const auto is_in_turn = [&](const SensorParameters& sensor) { return range_m >= sensor.use_from_m && range_m <= sensor.use_to_m; };
  if (is_in_turn(source.parameters)) return cameras[0];
  for (std::size_t i = 0; i < source.further_sensors.size(); ++i) {
    if (is_in_turn(source.further_sensors[i].parameters)) return cameras[i + 1];
  }
  return cameras[0];
}

// The scene before a camera that stands at a node.
std::shared_ptr<const SceneRun> run_before(const MissionSource& source, const Scene& scene, const FieldOfView& camera) {
  const Scenario& scenario = scene.setup.scenario;
  for (const FurtherSensor& sensor : source.further_sensors) {
    if (sensor.name == camera.name && sensor.T_sensor_own)
      return scene_run_from(scenario, scene.setup.range_m, period_us(scene.setup.parameters), sensor);
  }
  if (scenario.scene == nullptr)
    throw InputError("--camera " + camera.name + ": scenario " + scene.scenario +
                     " says ranges_m, and has no nodes: choose a scenario without, or a sensor");
  auto run = std::make_shared<SceneRun>(*scenario.scene);
  run->sensor = run->tree.need(camera.node);
  return run;
}

void look_through(const FieldOfView& camera, Scene& scene) {
  scene.camera = camera.name;
  scene.fov_half_x_rad = camera.half_x_rad;
  scene.fov_half_y_rad = camera.half_y_rad;
}

const Material& preset_of(const std::string& setting, const std::string& name) {
  if (const Material* preset = material_preset(name)) return *preset;
  std::vector<std::string> names;
  for (const Material& preset : material_presets()) names.emplace_back(preset.name);
  throw InputError("--material " + setting + ": no such material; there are " + list_of(names) + did_you_mean(name, names));
}

void set_material(const std::string& setting, const std::vector<std::string>& parts, std::vector<Material>& materials) {
  const std::size_t at = setting.rfind('=');
  if (at == std::string::npos || at == 0)
    throw InputError("--material " + setting + ": expected PART=MATERIAL, such as 'solar*=solar-cells'");
  const std::string pattern = setting.substr(0, at);
  const Material& preset = preset_of(setting, setting.substr(at + 1));
  bool found = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!matches_part(parts[i], pattern)) continue;
    materials[i] = preset;
    found = true;
  }
  if (!found)
    throw InputError("--material " + setting + ": the target has no such part" + did_you_mean(pattern, parts) + "; --as parts shows them");
}

Rgb colour(const std::vector<double>& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

Material material_of(const MaterialSource& source) {
  Material material = *material_preset(source.preset);
  if (!source.diffuse.empty()) material.reflection.diffuse = colour(source.diffuse);
  if (!source.specular.empty()) material.reflection.specular = colour(source.specular);
  material.reflection.roughness = source.roughness.value_or(material.reflection.roughness);
  material.tilt_rad = source.tilt_rad.value_or(material.tilt_rad);
  return material;
}

// By the mission, or else by the part's name; then as set on the command line.
std::vector<Material> materials_of(const std::vector<MaterialSource>& mission, const std::vector<std::string>& parts,
                                   const std::vector<std::string>& settings) {
  std::vector<Material> materials;
  for (const std::string& part : parts) materials.push_back(likely_material(part));
  for (const MaterialSource& source : mission) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto matches = [&](const std::string& pattern) { return matches_part(parts[i], pattern); };
      if (std::any_of(source.parts.begin(), source.parts.end(), matches)) materials[i] = material_of(source);
    }
  }
  for (const std::string& setting : settings) set_material(setting, parts, materials);
  return materials;
}

SurfaceBody simulated_body(const MissionInput& mission, const TargetParts& parts, const CaseSetup& setup, std::uint64_t seed) {
  if (!has_model_error(setup.scenario)) return {mission.mesh, parts.of_triangle, {}, 0};
  SurfaceBody body{true_target(mission.mesh, setup.scenario, seed), {}, {}, 0};
  for (const std::uint32_t triangle : kept_triangles(mission.mesh, setup.scenario))
    body.part_of_triangle.push_back(parts.of_triangle[triangle]);
  return body;
}

// What is seen at a time since the epoch, target first.
std::vector<SurfaceBody> bodies_at(const MissionSource& source, const CaseSetup& setup, const SurfaceBody& target,
                                   std::vector<std::string> names, TimeUs t_us) {
  std::vector<SurfaceBody> bodies{target};
  const SceneRun* run = setup.scenario.scene.get();
  for (std::size_t i = 0; run != nullptr && i < run->body_nodes.size(); ++i) {
    const BodySource& node = source.scene.bodies[i];
    const BodySurface& surface = run->surfaces->bodies[i];
    const std::vector<std::uint32_t> numbers = part_numbers_of(node, surface, names);
    SurfaceBody body{surface.mesh, {}, run->tree.state(run->body_nodes[i], run->target, t_us).T_a_b, 0};
    for (const std::uint32_t part : surface.part_of_triangle) body.part_of_triangle.push_back(numbers[part]);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

// Sun and Earth as a scene's camera sees them; the shadow is that at the orbit's origin.
std::optional<Lights> lights_of_orbit(const MissionSource& source, const SceneRun* run, TimeUs t_us) {
  if (run == nullptr || !source.scene.orbit) return std::nullopt;
  const scene::Orbit& orbit = *source.scene.orbit;
  const Quat q_sensor_hill = run->tree.state(0, run->sensor, t_us).T_a_b.q;
  const scene::Earthshine earth = orbit.earthshine(t_us);
  Lights lights;
  lights.sun = rotate(q_sensor_hill, orbit.sun_hill(t_us));
  lights.sun_share = orbit.sunlit_share(t_us);
  lights.earth = rotate(q_sensor_hill, earth.direction_hill);
  lights.earth_half_angle_rad = earth.half_angle_rad;
  return lights;
}

// Where they stand before a scene's camera. Their light is told in the band that cameras see; pictures show that of all the sun's.
std::vector<Lamp> lamps_of(const MissionSource& source, const SceneRun* run, TimeUs t_us) {
  std::vector<Lamp> lamps;
  if (run == nullptr) return lamps;
  for (const LampSource& lamp : source.scene.lamps) {
    const Pose pose = run->tree.state(run->tree.need(lamp.node), run->sensor, t_us).T_a_b;
    if (lamp.intensity_Wpsr > 0)
      lamps.push_back({pose.p, lamp.intensity_Wpsr / kBandShare, rotate(pose.q, Vec3::UnitZ()), lamp.half_angle_rad, true});
  }
  return lamps;
}

std::unique_ptr<ModelSurface> surface_at(const MissionInput& mission, const Scene& scene, TimeUs t_us) {
  const MissionSource& source = mission.source;
  const SurfaceBody target = simulated_body(mission, target_parts(source, mission.mesh), scene.setup, scene.seed);
  return std::make_unique<ModelSurface>(bodies_at(source, scene.setup, target, scene.parts, t_us), source.target.crease_angle_rad);
}

// The only scan of this case that is kept.
CaseResult flown_case(const CaseSetup& setup) {
  std::atomic<std::size_t> done{0};
  std::future<CaseResult> result = std::async(std::launch::async, [&] { return run_case(setup, done); });
  ProgressBar bar("track", setup.frames, "frames", 1);
  while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) bar.show(done);
  bar.finish();
  return result.get();
}

ScanMark mark_of(const RangeSample& sample, const sim::RayCaster& model, const sim::Trajectory& trajectory) {
  ScanMark mark;
  mark.direction = to_vec3(sample.direction);
  mark.state = sample.state;
  if (sample.state != RayState::kHit) return mark;
  const Pose T_target_sensor = inverse(trajectory.at(sample.t_us).T_sensor_target);
  const sim::RayHit hit = model.cast(T_target_sensor.p, rotate(T_target_sensor.q, mark.direction));
  mark.residual_m = hit.hit ? static_cast<double>(sample.range_m) - hit.range_m : std::numeric_limits<double>::quiet_NaN();
  return mark;
}

}  // namespace

std::string scenario_name(const MissionSource& source, const std::string& asked) {
  if (!asked.empty()) {
    static_cast<void>(scenario_of(source, asked));
    return asked;
  }
  if (source.scenarios.count("paper") != 0) return "paper";
  if (source.scenarios.empty())
    throw InputError(source.file.string() + ": has no scenario, so there is no place to see the target from: add a [scenario.NAME]");
  return source.scenarios.begin()->first;
}

Scene make_scene(const MissionInput& mission, const SceneRequest& request) {
  const MissionSource& source = mission.source;
  Scene scene;
  scene.scenario = scenario_name(source, request.scenario);
  const Scenario& scenario = scenario_of(source, scene.scenario);
  scene.seed = request.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  scene.setup = plain_case(source, scenario, scene.seed, 1, range_index(scenario, scene.scenario, request.range_m));
  scene.parts = scenario.scene != nullptr ? part_names_of(source, mission.mesh) : target_parts(source, mission.mesh).names;
  scene.materials = materials_of(source.materials, scene.parts, request.materials);
  move_scene(mission, to_us(request.time_s), scene);
  const FieldOfView camera = camera_of_mission(source, request.camera, scene.T_sensor_target.p.norm());
  look_through(camera, scene);
  if (camera.node.empty()) return scene;
  scene.view = run_before(source, scene, camera);
  move_scene(mission, to_us(request.time_s), scene);
  return scene;
}

void move_scene(const MissionInput& mission, TimeUs t_us, Scene& scene) {
  const MissionSource& source = mission.source;
  const SceneRun* run = scene.setup.scenario.scene.get();
  const bool alone = run == nullptr || run->body_nodes.empty();  // the target's own frame is that of the surface
  if (scene.surface == nullptr || !alone) scene.surface = surface_at(mission, scene, t_us);
  const SceneRun* seen = scene.view ? scene.view.get() : run;
  scene.orbit_lights = lights_of_orbit(source, seen, t_us);
  scene.lamps = lamps_of(source, seen, t_us);
  if (scene.view) {
    scene.T_sensor_target = scene.view->target_at(t_us).T_a_b;
    scene.T_camera_sensor = scene.view->tree.state(run != nullptr ? run->sensor : 0, scene.view->sensor, t_us).T_a_b;
    return;
  }
  const auto trajectory = make_trajectory(scene.setup.scenario, scene.setup.range_m, kEpochUs, period_us(scene.setup.parameters));
  scene.T_sensor_target = trajectory->at(kEpochUs + t_us).T_sensor_target;
}

Scene scene_of_case(const MissionInput& mission, const CaseSetup& setup, std::uint64_t seed, const std::string& camera, TimeUs t_us) {
  const MissionSource& source = mission.source;
  Scene scene;
  scene.seed = seed;
  scene.setup = setup;
  scene.parts = setup.scenario.scene != nullptr ? part_names_of(source, mission.mesh) : target_parts(source, mission.mesh).names;
  scene.materials = materials_of(source.materials, scene.parts, {});
  move_scene(mission, t_us, scene);
  look_through(camera_of_mission(source, camera, scene.T_sensor_target.p.norm()), scene);
  return scene;
}

Lights usual_lights() {
  Lights lights;
  lights.sun = Vec3(0.5, -0.5, -0.7).normalized();
  lights.earth = Vec3::UnitY();
  return lights;
}

std::vector<ScanMark> scan_marks(const CompiledMission& mission, const Scene& scene, const KeptScan& scan) {
  const std::unique_ptr<sim::RayCaster> model = make_target(mission.mesh);
  const auto trajectory = make_trajectory(scene.setup.scenario, scene.setup.range_m, kEpochUs, period_us(scene.setup.parameters));
  std::vector<ScanMark> marks;
  const std::size_t first_aimed = (scan.samples.size() - scan.aimed) / 2;
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    if (scene.view && scan.samples[i].state != RayState::kHit) continue;
    marks.push_back(mark_of(scan.samples[i], *model, *trajectory));
    if (scene.view)
      marks.back().direction =
          (scene.T_camera_sensor * (static_cast<double>(scan.samples[i].range_m) * marks.back().direction).eval()).normalized();
    marks.back().aimed = i >= first_aimed && i < first_aimed + scan.aimed;
  }
  return marks;
}

void check_scan_time(const Scene& scene, double time_s) {
  const Scenario& scenario = scene.setup.scenario;
  const DurationUs period = period_us(scene.setup.parameters);
  const DurationUs frame = to_us(time_s) / period;
  if (static_cast<double>(frame) < scenario.frames) return;
  throw InputError(format("--time %g: the scenario %s has scans for %g s: choose an earlier time, or leave the scan out", time_s,
                          scene.scenario.c_str(), scenario.frames * static_cast<double>(period) * 1e-6));
}

std::vector<ScanMark> flown_scan(const CompiledMission& mission, double time_s, Scene& scene, const MakeStereo& make_stereo) {
  check_scan_time(scene, time_s);
  const DurationUs period = period_us(scene.setup.parameters);
  const auto frame = static_cast<std::uint32_t>(to_us(time_s) / period);
  CaseSetup setup = scene.setup;
  const std::vector<std::uint8_t> image = image_bytes(mission, setup.parameters);
  setup.image = &image;
  setup.frames = frame + 1;
  setup.keep_frames = {frame};
  setup.make_stereo = make_stereo;
  const std::unique_ptr<sim::RayCaster> simulated = simulated_target(mission.mesh, setup.scenario, scene.seed, mission.source.target_laser);
  setup.target = simulated.get();
  const CaseResult result = flown_case(setup);
  // The first valid one is kept, too.
  if (result.scans.empty() || result.scans.back().frame != frame)
    throw InputError(
        format("--scan: in frame %u nothing was tracked, and so there is no scan of the target: choose another --time", frame));
  const KeptScan& scan = result.scans.back();
  move_scene(mission, scan.telemetry.t_measurement_us - kEpochUs, scene);
  return scan_marks(mission, scene, scan);
}

}  // namespace lasso::mdat
