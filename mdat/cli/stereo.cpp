#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/depth_window.hpp"
#include "mdat/stereo/disparity_errors.hpp"
#include "mdat/stereo/disparity_view.hpp"
#include "mdat/stereo/stereo_head.hpp"
#include "mdat/trial/flight_results.hpp"
#include "mdat/trial/trial_results.hpp"

namespace lasso::mdat {
namespace {

struct StereoArguments {
  std::string mission, out = "out/stereo";
  PairFiles recorded;
  MatchDepths depths{0, 0};
  SceneRequest scene;
  std::vector<std::string> settings;
  std::vector<std::string> lights;
  std::uint32_t views = 0, flights = 0;  // of each light; both 0: a pair
  std::optional<std::uint32_t> frames;   // of flights
  bool rendered = true;                  // of views and flights
  unsigned jobs = 1;
  bool force = false, cached = true;
};

constexpr const char* kPairFiles[] = {"left.png", "right.png", "calibration.toml", "errors.png", "truth.csv"};
constexpr const char* kTrialFiles[] = {"statistics.json", "pairs.csv", "poses.csv", "fit.txt"};
constexpr const char* kFlightFiles[] = {"flights.json", "flights.csv"};
constexpr const char* kMatchFiles[] = {"disparity.png", "scans/range.ply"};

// An earlier pair that this one would replace. Throws InputError.
void check_earlier_pair(const StereoArguments& options, bool recorded) {
  if (options.force) return;
  std::vector<std::filesystem::path> files;
  for (const char* file : kMatchFiles) files.push_back(std::filesystem::path(options.out) / file);
  for (const char* file : kPairFiles) {
    if (!recorded) files.push_back(std::filesystem::path(options.out) / file);
  }
  refuse_to_replace(files, "--force replaces it, --out DIR keeps it");
}

double percent_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

void tell_match(const DisparityMap& map, const MatchDepths& depths) {
  const auto share = [&](std::size_t count) { return percent_of(count, map.codes.codes.size()); };
  std::printf(
      "matched from %.3g m to %.3g m: %zu pixels, %.1f %% of the picture; %.1f %% are dark or beside what is bright, %.1f %% glints, %.1f "
      "%% without texture, "
      "%.1f %% ambiguous\n",
      depths.nearest_m, depths.farthest_m, map.counts.matched, share(map.counts.matched), share(map.counts.dark), share(map.counts.glint),
      share(map.counts.flat), share(map.counts.ambiguous));
  if (map.counts.matched == 0)
    std::fprintf(stderr, "warning: nothing was matched: it is dark, without texture, or not within these depths\n");
}

// mdat replay takes a folder of scans.
void write_match(const DisparityMap& map, OutputFolder& folder, OutputFolder& scans) {
  folder.write("disparity.png", png_bytes(disparity_view(map)));
  scans.write("range.ply", range_ply(map));
}

void tell_errors(const DisparityMap& map, const DisparityErrors& errors) {
  std::printf("valid: %.1f %% of the target; %.2f %% of what is valid is sky\n", 100 * errors.valid_share, 100 * errors.sky_share);
  std::printf(
      "disparity inside of surfaces: sigma %.3f px, median error %+.3f px; more than %g px wrong: %.1f %% there, %.1f %% within %d px of "
      "edges\n",
      errors.sigma_px, errors.bias_px, kWrong_px, 100 * errors.wrong_interior, 100 * errors.wrong_edge, kEdgeBand_px);
  std::printf("1 sigma of a depth at 3 m: %.1f mm\n", 1e3 * 9 * errors.sigma_px / (map.focal_px * map.baseline_m));
}

// As mdat replay takes it: the pose that range.ply was taken from.
std::string truth_csv(const Pose& T_sensor_target) {
  const Quat& q = T_sensor_target.q;
  const Vec3& p = T_sensor_target.p;
  return "scan,qx,qy,qz,qw,x_m,y_m,z_m\n" +
         format("range,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z());
}

StereoPictures pictures_of(const StereoArguments& options, const StereoView& view, const StereoHead& head, std::uint64_t seed) {
  StereoCamera camera(head, seed);
  ProgressBar bar("render", 2 * static_cast<std::size_t>(head.camera.height), "rows", 1);
  const StereoPictures pictures = camera.take(view, options.jobs, [&](std::size_t rows) { bar.show(rows); });
  bar.finish();
  std::printf("head: 2 x %d x %d pixels, focal length %.1f pixels, baseline %.3g m, f/%.3g; exposure %.3g ms, %.1f %% saturated\n",
              head.camera.width, head.camera.height, head.camera.focal_px, head.stated.T_left_right.p.norm(), head.source.f_number,
              1e3 * pictures.exposure_s, 100 * pictures.saturated);
  return pictures;
}

// The matcher sees what a user sees: files.
DisparityMap match_pictures(const StereoPictures& pictures, const StereoPair& stated, const MatchDepths& depths, OutputFolder& folder) {
  const ScratchFolder scratch;
  const PairFiles files{scratch.path() / kPairFiles[0], scratch.path() / kPairFiles[1], scratch.path() / kPairFiles[2]};
  const std::string contents[] = {grey_png(pictures.left), grey_png(pictures.right), stereo_pair_text(stated)};
  const std::filesystem::path* const places[] = {&files.left, &files.right, &files.calibration};
  for (std::size_t i = 0; i < std::size(contents); ++i) {
    write_file(*places[i], contents[i]);
    folder.write(kPairFiles[i], contents[i]);
  }
  return match_files(matcher_program(), files, depths);
}

void simulated_pair(const StereoArguments& options) {
  OutputFolder folder(options.out), scans(std::filesystem::path(options.out) / "scans");
  check_earlier_pair(options, false);
  const std::string scenario = scenario_name(load_mission(options.mission, options.settings), options.scene.scenario);
  const MissionInput input = load_mission_input(options.mission, options.settings, scenario);
  const Scene scene = make_scene(input, options.scene);
  tell_idle_settings(input.source, scene.scenario);
  const StereoSource& source = input.source.stereo;
  const StereoHead head = make_head(source, scene.fov_half_x_rad, scene.fov_half_y_rad);
  std::printf("scenario %s at %g s, range %.3f m\n", scene.scenario.c_str(), options.scene.time_s, scene.T_sensor_target.p.norm());
  const StereoView view{*scene.surface, stereo_materials(source, scene.materials), stereo_lights(source, scene.orbit_lights, scene.lamps),
                        scene.T_sensor_target};
  const StereoPictures pictures = pictures_of(options, view, head, scene.seed);
  const MatchDepths depths = options.depths.nearest_m > 0 ? options.depths : stated_depths(input.mesh, scene.setup, source.baseline_m);
  const DisparityMap map = match_pictures(pictures, head.stated, depths, folder);
  tell_match(map, depths);
  const std::vector<double> truth_px = true_disparities(map, *scene.surface, scene.T_sensor_target);
  tell_errors(map, disparity_errors(map, truth_px));
  write_match(map, folder, scans);
  folder.write("errors.png", png_bytes(error_view(map, truth_px)));
  folder.write("truth.csv", truth_csv(scene.T_sensor_target));
  folder.commit();
  scans.commit();
  std::printf("written to %s: left.png, right.png, calibration.toml, disparity.png, errors.png, truth.csv, scans/range.ply\n",
              options.out.c_str());
}

void recorded_pair(const StereoArguments& options) {
  OutputFolder folder(options.out), scans(std::filesystem::path(options.out) / "scans");
  check_earlier_pair(options, true);
  const StereoPair pair = load_stereo_pair(options.recorded.calibration);
  MatchDepths depths = options.depths;
  if (depths.nearest_m == 0) depths = {10 * pair.T_left_right.p.norm(), 1000 * pair.T_left_right.p.norm()};
  const DisparityMap map = match_files(matcher_program(), options.recorded, depths);
  tell_match(map, depths);
  write_match(map, folder, scans);
  folder.commit();
  scans.commit();
  std::printf("written to %s: disparity.png, scans/range.ply\n", options.out.c_str());
}

// Many pairs in stated lights: what they measure, and poses of scans of them.
void tried_pairs(const StereoArguments& options) {
  OutputFolder folder(options.out);
  if (!options.force) {
    std::vector<std::filesystem::path> files;
    for (const char* file : kTrialFiles) files.push_back(folder.path() / file);
    refuse_to_replace(files, "--force replaces them, --out DIR keeps them");
  }
  TrialOptions trial;
  trial.scenario = scenario_name(load_mission(options.mission, options.settings), options.scene.scenario);
  trial.range_m = options.scene.range_m;
  trial.views = options.views;
  trial.rendered = options.rendered;
  trial.lights = chosen_lights(options.lights);
  trial.jobs = options.jobs;
  MissionInput input = load_mission_input(options.mission, options.settings, trial.scenario);
  const TrialResult result = try_pairs(compile_mission(std::move(input), ModelCache::of_user_if(options.cached)), trial);
  const std::string contents[] = {trial_json(result), trial_pairs_csv(result), trial_poses_csv(result), fit_text(result.fit)};
  const std::size_t files = options.rendered ? std::size(contents) : std::size(contents) - 1;  // nothing was measured to be fitted to
  for (std::size_t i = 0; i < files; ++i) folder.write(kTrialFiles[i], contents[i]);
  folder.commit();
  std::fputs(trial_text(result).c_str(), stdout);
  std::printf("written to %s: statistics.json, pairs.csv, poses.csv%s\n", options.out.c_str(), options.rendered ? ", fit.txt" : "");
}

// Whole flights in stated lights, by rendered pairs and by fitted errors.
void flown_trials(const StereoArguments& options) {
  OutputFolder folder(options.out);
  if (!options.force) {
    std::vector<std::filesystem::path> files;
    for (const char* file : kFlightFiles) files.push_back(folder.path() / file);
    refuse_to_replace(files, "--force replaces them, --out DIR keeps them");
  }
  FlightTrialOptions trial;
  trial.scenario = scenario_name(load_mission(options.mission, options.settings), options.scene.scenario);
  trial.seed = options.scene.seed;
  trial.flights = options.flights;
  trial.frames = options.frames;
  trial.rendered = options.rendered;
  trial.lights = chosen_lights(options.lights);
  trial.jobs = options.jobs;
  MissionInput input = load_mission_input(options.mission, options.settings, trial.scenario);
  const FlightTrialResult result = try_flights(compile_mission(std::move(input), ModelCache::of_user_if(options.cached)), trial);
  folder.write(kFlightFiles[0], flights_json(result));
  folder.write(kFlightFiles[1], flights_csv(result));
  folder.commit();
  std::fputs(flights_text(result).c_str(), stdout);
  std::printf("written to %s: flights.json, flights.csv\n", options.out.c_str());
}

// Words that one of the two would not hear: many pairs, or many flights.
void check_kind_of_trial(const StereoArguments& options) {
  if (options.views > 0 && options.flights > 0) throw InputError("--views: single pairs, and --flights flies: leave one of them out");
  if (options.views > 0 && options.scene.seed) throw InputError("--views: --seed is of one pair, and of --flights: leave it out");
  if (options.flights > 0 && options.scene.range_m) throw InputError("--flights: --range is of pairs: choose a scenario of one range");
}

// Words of one way to use the command that the other one would not hear.
void check_trial(const StereoArguments& options, bool recorded) {
  const bool many = options.views > 0 || options.flights > 0;
  if (!many && !options.lights.empty()) throw InputError("--lights: goes with --views or --flights, which say how many each light has");
  if (options.frames && options.flights == 0) throw InputError("--frames: goes with --flights");
  if (!many) return;
  const std::string which = options.views > 0 ? "--views" : "--flights";
  if (recorded) throw InputError(which + ": pairs are those of a MISSION; leave out --left, --right and --calibration");
  if (options.depths.nearest_m > 0 || options.scene.time_s != 0 || !options.scene.camera.empty() || !options.scene.materials.empty())
    throw InputError(which + ": --nearest, --farthest, --time, --camera and --material are of one pair: leave them out");
  check_kind_of_trial(options);
}

void stereo(const StereoArguments& options) {
  const PairFiles& files = options.recorded;
  const bool recorded = !files.left.empty() || !files.right.empty() || !files.calibration.empty();
  if (recorded == !options.mission.empty())
    throw InputError("stereo: expected a MISSION, or --left, --right and --calibration of a recorded pair");
  if (recorded && (files.left.empty() || files.right.empty() || files.calibration.empty()))
    throw InputError("stereo: a recorded pair is --left, --right and --calibration, all three");
  if ((options.depths.nearest_m > 0) != (options.depths.farthest_m > 0) ||
      (options.depths.nearest_m > 0 && options.depths.farthest_m <= options.depths.nearest_m))
    throw InputError(format("--nearest %g --farthest %g: expected both, a depth above 0 and then a greater one", options.depths.nearest_m,
                            options.depths.farthest_m));
  check_trial(options, recorded);
  if (options.views > 0) return tried_pairs(options);
  if (options.flights > 0) return flown_trials(options);
  recorded ? recorded_pair(options) : simulated_pair(options);
}

using SharedStereo = std::shared_ptr<StereoArguments>;

void add_simulated_options(CLI::App* command, const SharedStereo& options) {
  command->add_option("--scenario", options->scene.scenario, "scenario of the mission (paper, or else the first by name)");
  command->add_option("--range", options->scene.range_m, "one of the scenario's ranges, m (its first)");
  command->add_option("--time", options->scene.time_s, "seconds since frame 0")->capture_default_str()->check(number_between(0.0, 1e6));
  command->add_option("--seed", options->scene.seed, "start of the random numbers (the scenario's)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4294967295}));
  command->add_option("--camera", options->scene.camera, "the sensor whose field of view the cameras have (the one whose turn it is)");
  command->add_option("--material", options->scene.materials, "PART=MATERIAL, as of mdat render; for more, again --material")
      ->type_name("PART=MATERIAL")
      ->allow_extra_args(false);
  command->add_option("-j,--jobs", options->jobs, "threads; no effect on the result")->capture_default_str()->check(CLI::Range(1, 256));
  add_settings(*command, options->settings);
}

}  // namespace

void add_stereo_command(CLI::App& app) {
  const auto options = std::make_shared<StereoArguments>();
  options->jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command =
      app.add_subcommand("stereo", "ranges from a stereo pair: of a mission's simulated target, or of two pictures of yours");
  command->add_option("MISSION", options->mission, "mission file; [stereo] says what the cameras and the light are");
  command->add_option("--left", options->recorded.left, "recorded: picture of the left camera (PNG, 8 bits)");
  command->add_option("--right", options->recorded.right, "recorded: picture of the right camera");
  command->add_option("--calibration", options->recorded.calibration, "recorded: calibration of the pair (docs/stereo.md)");
  command
      ->add_option("--nearest", options->depths.nearest_m,
                   "depth from which matches are looked for, m (by the mission's ranges; recorded: 10 baselines)")
      ->check(number_between(0.0, 1e6));
  command->add_option("--farthest", options->depths.farthest_m, "and to which (recorded: 1000 baselines)")->check(number_between(0.0, 1e6));
  add_simulated_options(command, options);
  command
      ->add_option("--views", options->views,
                   "instead of one pair: this many views of the scenario in each light, their disparities and poses as statistics")
      ->check(CLI::Range(1, 10000));
  command
      ->add_option("--flights", options->flights,
                   "instead: this many flights of the scenario in each light, by rendered pairs and by fitted errors, side by side")
      ->check(CLI::Range(1, 10000));
  command->add_option("--frames", options->frames, "of each flight (the scenario's)")->check(CLI::Range(1, 1000000));
  command->add_option("--lights", options->lights, "with --views or --flights: some of the lights, such as sun_behind,lamp (all)")
      ->delimiter(',');
  command->add_flag("!--fitted-only", options->rendered,
                    "with --views or --flights: by the fitted model alone, without pictures: in seconds");
  add_no_cache(*command, options->cached);
  command->add_option("-o,--out", options->out, "folder for the results")->capture_default_str();
  command->add_flag("--force", options->force, "replace an earlier pair in the folder");
  command->footer(
      "Examples:\n"
      "  mdat stereo hubble_tenth.toml --range 3 --set sensor.fov_half_x_deg=20 --set sensor.fov_half_y_deg=20\n"
      "  mdat stereo hubble_tenth.toml --range 3 --set 'stereo.sun=[0,0,0]' --set stereo.lamp_Wpsr=26\n"
      "  mdat stereo hubble_stereo.toml --views 6 --range 3\n"
      "  mdat stereo hubble_stereo.toml --flights 100 --fitted-only\n"
      "  mdat stereo --left L.png --right R.png --calibration C.toml --nearest 2 --farthest 5");
  command->callback([options] { stereo(*options); });
}

}  // namespace lasso::mdat
