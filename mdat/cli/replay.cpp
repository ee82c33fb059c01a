#include "mdat/replay/replay.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "mdat/cli/commands.hpp"
#include "mdat/cli/live_run.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/missiondb/depth_camera_file.hpp"
#include "mdat/recording/bag_scans.hpp"
#include "mdat/replay/acquire.hpp"
#include "mdat/replay/diagnosis.hpp"

namespace lasso::mdat {
namespace {

struct ReplayArguments {
  std::string mission, scenario, out, time_unit, axes, camera, topic;
  RecordedReplay recorded;  // what is for recordings alone
  LiveOptions live;         // that, too
  ReplayOptions replay;
  std::vector<double> offset_m;
  std::vector<std::string> settings;
  bool cached = true, force = false;
};

LoadedImage load(const ReplayArguments& options) {
  if (is_image_file(options.mission)) return LoadedImage(options.mission, read_bytes(options.mission));
  MissionInput input = load_mission_input(options.mission, options.settings, options.scenario);
  tell_idle_settings(input.source, options.scenario);
  const MissionParameters parameters = parameters_for(input.source, options.scenario);
  const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
  return LoadedImage(options.mission, image_bytes(mission, parameters));
}

// "out.csv": "out_candidates.csv".
std::filesystem::path candidates_file(std::filesystem::path out) {
  const std::string name = out.stem().string() + "_candidates" + out.extension().string();
  return out.replace_filename(name);
}

// What is written is none of what is read, nor beside the scans, where the next replay would read it.
void check_apart(const std::filesystem::path& out, const ReplayArguments& options) {
  std::error_code ignored;  // what is not there is told by who reads it
  for (const std::filesystem::path& input : {std::filesystem::path(options.mission), options.replay.scans, options.replay.initial,
                                             options.replay.truth, std::filesystem::path(options.camera)}) {
    if (!std::filesystem::equivalent(out, input, ignored)) continue;
    throw InputError(out.string() + ": is read by this replay; write to another file");
  }
  const std::filesystem::path& scans = options.replay.scans;
  if (!std::filesystem::equivalent(std::filesystem::absolute(out).parent_path(), scans, ignored)) return;
  throw InputError(out.string() + ": lies in the folder of the scans, " + scans.string() + ", which are left as they are; write elsewhere");
}

void tell(const Notes& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "%s\n", note.c_str());
}

// What an earlier replay has written.
void check_earlier(const std::filesystem::path& out, const ReplayArguments& options) {
  if (!options.force) refuse_to_replace({out}, "--force replaces it");
}

void search(const ReplayArguments& options) {
  if (options.replay.closed_loop || options.replay.wide) {
    throw InputError("--initial search: each scan is searched on its own; leave --closed-loop and --wide out");
  }
  const std::filesystem::path candidates = candidates_file(options.out);
  check_apart(options.out, options);
  check_apart(candidates, options);
  check_earlier(options.out, options);
  check_earlier(candidates, options);
  check_writable(options.out);
  check_writable(candidates);
  ReplayInput input = read_replay_input(options.replay);
  const LoadedImage image = load(options);
  tell(settle_times(options.replay, image.mission().parameters.duration_s, input));
  tell(range_notes(image.mission(), options.replay, input));
  const std::vector<AcquiredScan> scans = acquire(image.mission(), input.scans, input.truth);
  write_file(options.out, acquired_csv(scans));
  write_file(candidates, candidates_csv(scans));
  std::fputs((acquired_summary(scans) + options.out + ", " + candidates.string() + ": written\n").c_str(), stdout);
}

double unit_of(const std::string& name) {
  constexpr std::pair<const char*, double> kUnits[] = {{"min", 60}, {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  for (const auto& [known, unit_s] : kUnits) {
    if (name == known) return unit_s;
  }
  return 0;
}

// The options that say how the scans' files are meant.
void read_frame(const ReplayArguments& options, ReplayOptions& replay) {
  replay.unit_s = unit_of(options.time_unit);
  if (!options.axes.empty()) replay.frame.R_sensor_file = sim::axes_of(options.axes);
  if (!options.offset_m.empty()) replay.frame.sensor_m = Vec3(options.offset_m[0], options.offset_m[1], options.offset_m[2]);
  if (!options.camera.empty()) replay.camera = load_depth_camera(options.camera);
  if (is_bag(options.replay.scans)) {
    replay.source = open_bag(options.replay.scans, options.topic);
  } else if (!options.topic.empty()) {
    throw InputError("--topic " + options.topic + ": " + options.replay.scans.string() +
                     " is no recording (.mcap, .db3, or a bag's folder)");
  }
}

// Other people's scans need to be said where they are; a recording of a run has all in itself.
void check_given(const ReplayArguments& options) {
  const std::pair<const char*, bool> kNeeded[] = {
      {"--scans", !options.replay.scans.empty()}, {"--initial", !options.replay.initial.empty()}, {"--out", !options.out.empty()}};
  for (const auto& [name, given] : kNeeded) {
    if (!given) throw InputError(std::string(name) + " is required, unless a recording (.mcap) is replayed");
  }
}

RecordedReplay recorded_replay(const ReplayArguments& options) {
  RecordedReplay recorded = options.recorded;
  recorded.file = options.mission;
  recorded.settings = options.settings;
  recorded.cached = options.cached;
  recorded.force = options.force;
  return recorded;
}

// What scans of others do not have.
void refuse_for_recordings(const ReplayArguments& options) {
  const std::pair<const char*, const std::string&> kOfRecordings[] = {{"--mission", options.recorded.mission},
                                                                      {"--image", options.recorded.image},
                                                                      {"--record", options.recorded.record},
                                                                      {"--key", options.recorded.key}};
  for (const auto& [name, value] : kOfRecordings) {
    if (!value.empty()) throw InputError(std::string(name) + " " + value + ": is for a recording of a run (.mcap) alone");
  }
  if (options.live.address) throw InputError("--live: is for a recording of a run (.mcap) alone");
}

bool is_recording(const ReplayArguments& options) { return std::filesystem::path(options.mission).extension() == ".mcap"; }

void run(ReplayArguments options) {
  if (is_recording(options)) return replay_recording(recorded_replay(options), options.live);
  refuse_for_recordings(options);
  check_given(options);
  read_frame(options, options.replay);
  if (!options.settings.empty() && is_image_file(options.mission))
    throw InputError("--set " + options.settings.front() + ": " + options.mission +
                     " is a flight image, whose values are fixed; give its mission");
  if (options.replay.initial == "search") return search(options);
  check_apart(options.out, options);
  check_earlier(options.out, options);
  check_writable(options.out);
  ReplayInput input = read_replay_input(options.replay);
  const LoadedImage image = load(options);
  tell(settle_times(options.replay, image.mission().parameters.duration_s, input));
  const Notes ranges = range_notes(image.mission(), options.replay, input);
  tell(ranges);
  tell(value_notes(image.mission(), options.replay, input));
  if (ranges.empty()) tell(reading_notes(image.mission(), options.replay, input));
  const std::vector<ReplayedScan> scans = replay(image.mission(), options.replay, input);
  write_file(options.out, replay_csv(scans));
  tell(noise_notes(image.mission(), input, scans));
  tell(mismatch_notes(image.mission(), scans));
  tell(truth_notes(input.truth, judged(scans)));
  std::fputs((replay_summary(scans) + options.out + ": written\n").c_str(), stdout);
}

void add_recording_options(CLI::App& command, RecordedReplay& recorded) {
  command.add_option("--mission", recorded.mission, "of a recording: fly its scans with this mission's component, and print both");
  command.add_option("--image", recorded.image, "of a recording: fly its scans with this flight image (.3dli), and print both");
  command.add_option("--record", recorded.record, "of a recording: also record the replay, FILE.mcap");
  command.add_option("--key", recorded.key, "of a recording whose commands were signed: file with the key (64 hexadecimal digits)");
}

}  // namespace

void add_replay_command(CLI::App& app) {
  const auto options = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay", "register recorded scans (" + sim::scan_extensions() + ") from given initial poses, or fly a recorded run (.mcap) again");
  command
      ->add_option("MISSION", options->mission,
                   "mission file or flight image, for --scans; or a recording of a run (.mcap), which needs nothing else")
      ->required();
  command->add_option("--scans", options->replay.scans,
                      "folder of scans, taken in natural order (scan2 before scan10); or a recording of any program with "
                      "PointCloud2: .mcap, .db3, or a bag's folder");
  command->add_option("--topic", options->topic, "which scans of a recording, where it has several topics of them");
  command->add_option("--initial", options->replay.initial,
                      "poses to start from: scan,qx,qy,qz,qw,x_m,y_m,z_m (T_sensor_target); or the word search: find each scan's "
                      "without any");
  command->add_option("-o,--out", options->out, "file of poses to write");
  command->add_flag("--closed-loop", options->replay.closed_loop,
                    "start from the first row, then from the filter's prediction, as in flight");
  command->add_flag("--wide", options->replay.wide, "the initial poses are rough (20 deg, a quarter of the target's size)");
  command->add_option("--truth", options->replay.truth, "true poses, as --initial: prints errors, and adds them to each row");
  command->add_option(
      "--axes", options->axes,
      "what the scans' x, y and z point to, such as forward-right-down (default right-down-forward); or which of them the sensor's "
      "x, y and z are, such as y,z,x");
  command->add_option("--sensor-offset", options->offset_m, "X,Y,Z [m]: where the sensor stands in the scans' frame and axes")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--depth-camera", options->camera, "calibration of depth images (.png): a file that says fx, fy, cx, cy and scale_m");
  command->add_option("--scale", options->replay.frame.scale, "metres in a unit of the scans' lengths, as 0.001 for millimetres")
      ->check(number_between(1e-6, 1e6));
  command->add_option("--time-unit", options->time_unit, "of the scans' times (default: by their span against scan.duration_s)")
      ->check(CLI::IsMember({"min", "s", "ms", "us", "ns"}));
  command->add_option("--scenario", options->scenario, "with this scenario's overrides of parameters");
  add_settings(*command, options->settings);
  add_recording_options(*command, options->recorded);
  add_live_options(*command, options->live);
  command->add_flag("--force", options->force, "replace the files of an earlier replay");
  add_no_cache(*command, options->cached);
  command->callback([options] { run(*options); });
}

}  // namespace lasso::mdat
