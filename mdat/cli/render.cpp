#include "mdat/render/render.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/render/exposure.hpp"
#include "mdat/render/orbit_light.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

constexpr int kLargest_px = 4096;
constexpr int kUsual_px = 1024;
constexpr double kLowest_km = 100, kHighest_km = 100000;

struct RenderArguments {
  std::string mission, as = "photo", size, sun, earth, orbit, out;
  SceneRequest scene;
  std::vector<std::string> settings;
  int samples = 3;
  unsigned jobs = 1;
  bool scan = false, lamp = false, earthshine = true, cached = true, force = false;
  double white = 0;  // 0: chosen
};

bool has_scan(const RenderArguments& options) { return options.scan || options.as == "residual"; }

[[noreturn]] void refuse_value(const char* option, const std::string& value, const std::string& expected) {
  throw InputError(std::string(option) + " " + value + ": expected " + expected);
}

// Numbers with `separator` between them, and nothing else; none where one is no number.
std::vector<double> numbers_in(const std::string& text, char separator) {
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at <= end; ++at) {
    double number = 0;
    const std::from_chars_result read = std::from_chars(at, end, number);
    if (read.ec != std::errc() || (read.ptr != end && *read.ptr != separator)) return {};
    numbers.push_back(number);
    at = read.ptr;
  }
  return numbers;
}

// "1024x768"
std::optional<PictureSize> size_given(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<double> sides = numbers_in(text, 'x');
  const auto fits = [](double side) { return side >= 1 && side <= kLargest_px && side == std::floor(side); };
  const bool good = sides.size() == 2 && fits(sides[0]) && fits(sides[1]);
  if (!good) refuse_value("--size", text, "WIDTHxHEIGHT in pixels, each 1 to " + std::to_string(kLargest_px) + ", such as 1024x768");
  return PictureSize{static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

// "x,y,z", or "none".
std::optional<Vec3> direction_given(const char* option, const std::string& text) {
  if (text == "none") return std::nullopt;
  const std::vector<double> xyz = numbers_in(text, ',');
  const Vec3 direction = xyz.size() == 3 ? Vec3(xyz.data()) : Vec3::Zero();
  const bool good = direction.allFinite() && direction.norm() > 0;
  if (!good) refuse_value(option, text, "X,Y,Z, the direction in the sensor frame (x right, y down, z ahead), not 0,0,0; or none");
  return direction.normalized();
}

// "ALTITUDE,BETA,ANGLE" in km and degrees; the scenario's time is that of the orbit.
Lights orbit_given(const std::string& text, double time_s) {
  const std::vector<double> orbit = numbers_in(text, ',');
  const bool good =
      orbit.size() == 3 && orbit[0] >= kLowest_km && orbit[0] <= kHighest_km && std::fabs(orbit[1]) <= 90 && std::fabs(orbit[2]) <= 360;
  if (!good)
    refuse_value("--orbit", text,
                 "ALTITUDE,BETA,ANGLE: 100 to 100000 km, the sun's elevation above the orbit plane (-90 to 90 deg), and the way from orbit "
                 "noon at 0 s (-360 to 360 deg), such as 400,25,60");
  scene::Orbit::Setup setup;
  setup.altitude_m = 1e3 * orbit[0];
  setup.beta_rad = orbit[1] * kRadPerDeg;
  setup.angle_rad = orbit[2] * kRadPerDeg;
  return orbit_lights(scene::Orbit(setup), to_us(time_s));
}

// Of a scene's orbit, or else the usual ones, but for what is given.
Lights lights_by_directions(const RenderArguments& options, Lights lights) {
  if (!options.sun.empty()) {
    lights.sun = direction_given("--sun", options.sun);
    lights.sun_share = 1;
  }
  if (!options.earth.empty()) lights.earth = direction_given("--earth", options.earth);
  return lights;
}

Lights lights_given(const RenderArguments& options, const std::optional<Lights>& of_scene, const std::vector<Lamp>& lamps) {
  Lights lights = options.orbit.empty() ? lights_by_directions(options, of_scene.value_or(usual_lights()))
                                        : orbit_given(options.orbit, options.scene.time_s);
  if (!options.earthshine) lights.earth.reset();
  lights.lamps = lamps;
  if (options.lamp) lights.lamps.push_back(lamp_at_camera(kLamp_Wpsr));
  return lights;
}

std::filesystem::path out_file(const RenderArguments& options) {
  if (!options.out.empty()) return options.out;
  const std::string scan = options.scan && options.as != "residual" ? "_scan" : "";
  return std::filesystem::path("out/render") / (std::filesystem::path(options.mission).stem().string() + "_" + options.as + scan + ".png");
}

// Before any long work. The folder of a file that nobody named is made.
void check_out(const RenderArguments& options, const std::filesystem::path& out) {
  if (!options.force) refuse_to_replace({out}, "--force replaces it, --out FILE keeps it");
  refuse_same_files({out.string()}, {options.mission});
  if (!options.out.empty()) check_writable(out);
}

void write_out(const RenderArguments& options, const std::filesystem::path& out, const std::string& bytes) {
  if (!options.out.empty()) return write_file(out, bytes);
  OutputFolder folder(out.parent_path());
  folder.write(out.filename().string(), bytes);
  folder.commit();
}

Picture photo_of(const RenderArguments& options, const Scene& scene, const RenderSetup& setup, const std::vector<SeenPoint>& seen) {
  RenderSetup shown = setup;
  ProgressBar bar("render", static_cast<std::size_t>(setup.camera.height), "rows", 1);
  shown.progress = [&](std::size_t rows) { bar.show(rows); };
  const std::vector<Rgb> radiance =
      rendered(*scene.surface, scene.materials, lights_given(options, scene.orbit_lights, scene.lamps), shown);
  bar.finish();
  const double white = options.white > 0 ? options.white : automatic_white(radiance, seen);
  if (white > 0) {
    std::printf("exposure: %.4g W/m2/sr is white%s\n", white,
                options.white > 0 ? "" : ": 85 % of the lit pixels of the target are darker than half of it");
  } else {
    std::fprintf(stderr, "warning: nothing lit is in view: the picture is black; another %s, --lamp, or --time shows more\n",
                 options.orbit.empty() ? "--sun" : "ANGLE of --orbit");
  }
  return photo(radiance, setup.camera, white);
}

std::string picture_bytes(const RenderArguments& options, const Scene& scene, const RenderSetup& setup,
                          const std::vector<ScanMark>& marks) {
  const Camera& camera = setup.camera;
  const std::vector<SeenPoint> seen = seen_points(*scene.surface, setup);
  if (std::none_of(seen.begin(), seen.end(), [](const SeenPoint& point) { return point.hit; }))
    std::fprintf(stderr, "warning: the target is not in the field of view of %s at this time\n", scene.camera.c_str());
  if (options.as == "depth16") return png_bytes(camera.width, camera.height, depth_mm(seen));
  const auto view = [&] {
    if (options.as == "depth") return depth_view(seen, camera);
    if (options.as == "normals") return normals_view(seen, camera);
    if (options.as == "parts") return parts_view(seen, camera, scene.parts);
    return photo_of(options, scene, setup, seen);
  };
  if (options.as == "residual") return png_bytes(residual_view(view(), camera, marks));
  return png_bytes(options.scan ? scan_view(view(), camera, marks) : view());
}

void tell_scene(const RenderArguments& options, const Scene& scene, const Camera& camera) {
  const Vec3& p = scene.T_sensor_target.p;
  std::printf("scenario %s at %g s, target's origin at x %.3f, y %.3f, z %.3f m\n", scene.scenario.c_str(), options.scene.time_s, p.x(),
              p.y(), p.z());
  std::printf("camera %s: %d x %d pixels, focal length %.3f pixels, middle at %.1f, %.1f\n", scene.camera.c_str(), camera.width,
              camera.height, camera.focal_px, camera.center_x, camera.center_y);
}

// Which part is of what, where light has a say.
void tell_materials(const Scene& scene) {
  for (const Material& preset : material_presets()) {
    std::string parts;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
      if (scene.materials[i].name == preset.name) parts += (parts.empty() ? "" : "; ") + scene.parts[i];
    }
    if (!parts.empty()) std::printf("%s: %s\n", preset.name, parts.c_str());
  }
}

void tell_scan(const std::vector<ScanMark>& marks) {
  std::size_t returns = 0, on_model = 0;
  double sum_m2 = 0;
  for (const ScanMark& mark : marks) {
    if (mark.state != RayState::kHit) continue;
    ++returns;
    if (std::isnan(mark.residual_m)) continue;
    ++on_model;
    sum_m2 += mark.residual_m * mark.residual_m;
  }
  std::printf("scan: %zu rays, %zu returns, %zu of them where the model is", marks.size(), returns, on_model);
  if (on_model > 0) std::printf(": measured minus predicted range %.4f mm rms", 1e3 * std::sqrt(sum_m2 / static_cast<double>(on_model)));
  std::printf("\n");
}

void render(const RenderArguments& options) {
  const std::optional<PictureSize> size = size_given(options.size);
  static_cast<void>(lights_given(options, std::nullopt, {}));
  if (options.scan && options.as == "depth16") throw InputError("--scan: --as depth16 holds depths alone; --as depth shows a scan as well");
  const std::filesystem::path out = out_file(options);
  check_out(options, out);
  const std::string scenario = scenario_name(load_mission(options.mission, options.settings), options.scene.scenario);
  MissionInput input = load_mission_input(options.mission, options.settings, scenario);
  Scene scene = make_scene(input, options.scene);
  tell_idle_settings(input.source, scene.scenario);
  std::vector<ScanMark> marks;
  if (has_scan(options)) {
    check_scan_time(scene, options.scene.time_s);
    const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
    const MakeStereo stereo = has_stereo_head(mission.source) ? stereo_maker(mission, scene.seed, options.jobs) : MakeStereo{};
    marks = flown_scan(mission, options.scene.time_s, scene, stereo);
  }
  RenderSetup setup;
  setup.camera =
      camera_of(size.value_or(size_of(kUsual_px, scene.fov_half_x_rad, scene.fov_half_y_rad)), scene.fov_half_x_rad, scene.fov_half_y_rad);
  setup.T_sensor_target = scene.T_sensor_target;
  setup.samples_per_axis = options.samples;
  setup.jobs = options.jobs;
  tell_scene(options, scene, setup.camera);
  if (!options.orbit.empty() || (scene.orbit_lights && options.sun.empty()))
    std::printf("orbit: %.1f %% of the sun's disc is seen\n", 100 * lights_given(options, scene.orbit_lights, {}).sun_share);
  if (!marks.empty()) tell_scan(marks);
  if (options.as == "photo" || options.as == "residual") tell_materials(scene);
  write_out(options, out, picture_bytes(options, scene, setup, marks));
  std::printf("written: %s\n", out.c_str());
}

void add_light_options(CLI::App* command, const std::shared_ptr<RenderArguments>& options) {
  CLI::Option* sun =
      command->add_option("--sun", options->sun,
                          "direction to the sun in the sensor frame (x right, y down, z ahead), X,Y,Z (that of the scene's orbit, or else "
                          "0.5,-0.5,-0.7); none: it is dark");
  CLI::Option* earth =
      command->add_option("--earth", options->earth,
                          "direction to the middle of Earth's disc, which sends back the sun's light; X,Y,Z or none (that of the scene's "
                          "orbit, or else 0,1,0)");
  command
      ->add_option(
          "--orbit", options->orbit,
          "sun and Earth by a circular orbit, ALTITUDE,BETA,ANGLE: km, the sun's elevation above its plane, the way from orbit noon at "
          "0 s, deg; the camera looks along the track with the Earth below; with Earth's shadow")
      ->excludes(sun)
      ->excludes(earth);
  command->add_flag("!--no-earthshine", options->earthshine, "leave Earth's light out");
  command->add_flag("--lamp", options->lamp, "a lamp at the camera, 26 W/sr");
  command
      ->add_option("--exposure", options->white,
                   "radiance that is white, W/m2/sr (otherwise 85 % of the lit pixels of the target are darker than half of white)")
      ->check(number_between(1e-9, 1e9));
  command
      ->add_option(
          "--material", options->scene.materials,
          "PART=MATERIAL, instead of what the part's name suggests; PART may end with *. white-paint, silver-teflon, aluminium-foil, "
          "mli, solar-cells, black-anodised or regolith; for more, again --material")
      ->type_name("PART=MATERIAL")
      ->allow_extra_args(false);
}

void add_scene_options(CLI::App* command, const std::shared_ptr<RenderArguments>& options) {
  command->add_option("--scenario", options->scene.scenario, "scenario of the mission (paper, or else the first by name)");
  command->add_option("--range", options->scene.range_m, "one of the scenario's ranges, m (its first)");
  command->add_option("--time", options->scene.time_s, "seconds since frame 0; with a scan, that of the frame at this time")
      ->capture_default_str()
      ->check(number_between(0.0, 1e6));
  command->add_option("--seed", options->scene.seed, "start of the random numbers (the scenario's)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4294967295}));
  command->add_option("--camera", options->scene.camera,
                      "the sensor, or the node with a camera, whose view is shown (the sensor whose turn it is at this range)");
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderArguments>();
  options->jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command =
      app.add_subcommand("render", "write a picture of what a sensor or a camera sees of a mission's simulated target (PNG)");
  command->add_option("MISSION", options->mission, "mission file")->required();
  command
      ->add_option("--as", options->as, "photo, depth, depth16 (millimetres in 16 bits), normals, parts, or residual (of a scan's returns)")
      ->capture_default_str()
      ->check(CLI::IsMember({"photo", "depth", "depth16", "normals", "parts", "residual"}));
  command->add_flag("--scan", options->scan, "fly up to this time as mdat run does, and draw the rays of the frame's scan");
  add_scene_options(command, options);
  add_light_options(command, options);
  command->add_option("--size", options->size,
                      "WIDTHxHEIGHT in pixels (the field of view's shape, 1024 pixels long); a legend, where there is one, is added below");
  command->add_option("--samples", options->samples, "rays of a pixel are this number squared")
      ->capture_default_str()
      ->check(CLI::Range(1, 16));
  command->add_option("-o,--out", options->out, "file to write (out/render/MISSION_AS.png)");
  command->add_option("-j,--jobs", options->jobs, "threads; no effect on the picture")->capture_default_str()->check(CLI::Range(1, 256));
  add_settings(*command, options->settings);
  command->add_flag("--force", options->force, "replace a file that is there");
  add_no_cache(*command, options->cached);
  command->footer(
      "Examples:\n"
      "  mdat render hubble_tenth.toml\n"
      "  mdat render hubble_tenth.toml --scenario spin --time 12 --sun none --lamp --size 512x512 --samples 1\n"
      "  mdat render hubble_tenth.toml --as residual --range 3\n"
      "  mdat render hubble_tenth.toml --material 'body=white-paint' --sun 1,0,0 --no-earthshine -o side.png");
  command->callback([options] { render(*options); });
}

}  // namespace lasso::mdat
