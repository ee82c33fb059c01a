#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "bsp/posix/links.hpp"
#include "mdat/campaign/run_junit.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/cli/live_run.hpp"
#include "mdat/cli/run_output.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/signature.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/missiondb/camera_faults.hpp"
#include "mdat/recording/recorded_run.hpp"
#include "mdat/recording/run_recorders.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/results.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

struct RunArguments {
  std::string mission, sensor = "simulated", camera_faults, optics, calibration, out = "out/run", picture, record, record_for = "viewers",
                       link, told, key, junit;
  LiveOptions live;
  SimulationOptions simulation;
  std::vector<std::string> settings, required;
  bool report = true, cached = true, force = false;
};

// All that a run writes into its folder.
constexpr const char* kFiles[] = {"results.json", "frames.csv", "telemetry.ccsds", "relative.csv", "report.html"};

constexpr char kReplay[] = "replay:";  // of --sensor, before a recording

void check_record(const std::string& file) {
  if (file.empty() || std::filesystem::path(file).extension() == ".mcap") return;
  throw InputError("--record " + file +
                   ": expected FILE.mcap, which holds all of a run; its scans as tables: mdat recording export FILE.mcap "
                   "--format scans");
}

// An option of its own goes before --set.
void tell_replaced(const MissionSource& source, const SimulationOptions& simulation) {
  const auto tell = [&](const char* name, bool given) {
    const auto origin = source.origins.find("scenario." + simulation.scenario + "." + name);
    if (given && origin != source.origins.end() && origin->second.set)
      std::fprintf(stderr, "warning: --set %s: has no effect beside --%s, which holds\n", origin->first.c_str(), name);
  };
  tell("frames", simulation.frames.has_value());
  tell("seed", simulation.seed.has_value());
}

MissionInput load_input(const RunArguments& options) {
  MissionInput input = load_mission_input(options.mission, options.settings, options.simulation.scenario);
  tell_idle_settings(input.source, options.simulation.scenario);
  tell_replaced(input.source, options.simulation);
  return input;
}

// An earlier run, or a file, that this one would replace. Throws InputError.
void check_earlier(const RunArguments& options) {
  if (options.force) return;
  const std::string folder = options.out;
  std::vector<std::filesystem::path> files;
  for (const char* file : kFiles) files.push_back(std::filesystem::path(folder) / file);
  refuse_to_replace(files, "--force replaces that run, --out DIR keeps it");
  refuse_to_replace({options.picture, options.junit}, "--force replaces it");
}

// Files that the run writes outside of its folder, and `recordings`, are none that it reads, with --force too. Throws InputError.
void check_apart_from_inputs(const RunArguments& options, const std::vector<std::filesystem::path>& recordings) {
  std::vector<std::string> outputs = {options.junit, options.picture};
  for (const std::filesystem::path& file : recordings) outputs.push_back(file.string());
  std::vector<std::string> inputs = {options.mission, options.camera_faults, options.optics, options.calibration, options.key};
  if (options.sensor.rfind(kReplay, 0) == 0) inputs.push_back(options.sensor.substr(sizeof kReplay - 1));
  refuse_same_files(outputs, inputs);
}

// An operator's link; none if there is no URL. Who reads its address finds the component running: it is told when the mission is compiled.
// From other machines it is reached with a key, or where the user says so.
std::unique_ptr<posix::PosixLink> open_link(const RunArguments& options) {
  if (options.link.empty()) return nullptr;
  try {
    if (options.key.empty() && !options.simulation.remote_line && posix::is_reached_from_elsewhere(options.link))
      throw InputError("--link " + options.link +
                       ": whoever reaches this machine could command the run: add --key FILE, so that only signed commands count, "
                       "or --remote to allow it");
    return posix::open_link(options.link, options.told, {PacketType::kCommand, options.simulation.apid});
  } catch (const posix::LinkError& error) {
    const std::string what = error.what();
    const bool of_receiver = !options.told.empty() && what.rfind(options.told + ": ", 0) == 0;
    throw InputError((of_receiver ? "--telemetry-to " : "--link ") + what);
  }
}

void tell_address(const posix::PosixLink& link) {
  std::printf("commands and telemetry by %s\n", link.address().c_str());
  (void)std::fflush(stdout);
}

void warn_of_replay(const SimulationResult& result) {
  const CaseResult& run = result.tables[0].variants[0].cases[0];  // a recording plays in one case alone
  if (run.replay_rounds > 0) {
    std::fprintf(
        stderr,
        "warning: --sensor replay: the recording was at its end, and began anew (%u times): the target jumps there; fewer --frames "
        "end before it\n",
        run.replay_rounds);
  }
  if (run.replay_unserved == 0) return;
  std::fprintf(
      stderr,
      "warning: --sensor replay: %u scans are not in the recording, and were lost: it is shorter than the run (fewer --frames), or "
      "the scans were planned otherwise\n",
      run.replay_unserved);
}

// A run over a link keeps the clock's pace.
std::optional<serve::PlaybackRange> playback_of(const SimulationOptions& simulation, const MissionSource& mission) {
  if (simulation.link != nullptr) return std::nullopt;
  const std::int64_t frames = simulation.frames.value_or(static_cast<std::uint32_t>(scenario_of(mission, simulation.scenario).frames));
  return playback_range(static_cast<std::uint64_t>(frames), parameters_for(mission, simulation.scenario).period_s);
}

// Places of the run's recordings, where it has any: nothing may be there, and they can be written.
std::vector<std::filesystem::path> recordings_of(const RunArguments& options, const MissionSource& mission) {
  if (options.record.empty()) return {};
  const Scenario& scenario = scenario_of(mission, options.simulation.scenario);
  std::vector<double> ranges_m = scenario.runs_m();
  if (!options.link.empty()) ranges_m.resize(1);
  std::vector<std::filesystem::path> files = recording_files(options.record, ranges_m);
  check_apart_from_inputs(options, files);
  if (!options.force) refuse_to_replace(files, "--force replaces it");
  for (const std::filesystem::path& file : files) check_writable(file);
  return files;
}

// What flies a run of another application process, or a commanded one, again, besides the commands.
void tell_link(const RunArguments& options, const ByteLink* link, std::uint64_t signed_before, RecordingHead& head) {
  if (options.simulation.apid != kApid) head.about[kOfApid] = std::to_string(options.simulation.apid);
  if (link == nullptr) return;
  head.about[kLinkForm] = link->datagrams() ? kDatagrams : kByteStream;
  if (!options.key.empty()) head.about[kSigned] = std::to_string(signed_before);
  if (options.simulation.store.empty()) return;
  head.about[kHasStore] = "yes";
  head.files.merge(store_files(options.simulation.store));
}

std::unique_ptr<RunRecorders> open_recorders(const RunArguments& options, const std::vector<std::filesystem::path>& files,
                                             const CompiledMission& mission, const ByteLink* link, std::uint64_t signed_before) {
  if (files.empty()) return nullptr;
  RecordingHead head = recording_head(mission, options.simulation, options.settings, {{"commit", kCommit}, {"sensor", options.sensor}});
  if (!options.calibration.empty()) head.files[kCalibrationAttachment] = file_content(options.calibration);
  tell_link(options, link, signed_before, head);
  return std::make_unique<RunRecorders>(files, mission, head, recording_content(options.record_for));
}

// Pictures of one case take all cores; those of several cases one each.
MakeStereo stereo_for(const MissionInput& mission, const SimulationOptions& simulation) {
  if (!has_stereo_head(mission.source)) return {};
  const Scenario& scenario = scenario_of(mission.source, simulation.scenario);
  const unsigned jobs = scenario.runs_m().size() == 1 ? std::max(1U, std::thread::hardware_concurrency()) : 1U;
  return stereo_maker(mission, simulation.seed.value_or(static_cast<std::uint64_t>(scenario.seed)), jobs);
}

// What --require asks. Throws InputError, before anything is flown.
std::vector<Criterion> required_criteria(const RunArguments& options) {
  std::vector<Criterion> criteria;
  for (const std::string& text : options.required) criteria.push_back(required_criterion(text));
  if (!options.junit.empty()) check_writable(options.junit);
  return criteria;
}

// Of a run whose commands and images have to be signed; otherwise empty.
struct RunSignatures {
  explicit RunSignatures(const RunArguments& options) {
    if (options.key.empty()) return;
    const Key master = load_master_key(options.key);
    before = state_at_start(options.simulation.store, options.link);
    check = std::make_unique<SignatureCheck>(master, before, keep_in(options.simulation.store));
    sign = [master](const std::vector<std::uint8_t>& image) { return sign_image(image, master); };
  }
  SignatureState before;
  std::unique_ptr<SignatureCheck> check;
  SignImage sign;
};

void run(const RunArguments& options) {
  OutputFolder folder(options.out);
  check_earlier(options);
  check_apart_from_inputs(options, {});
  const std::vector<Criterion> required = required_criteria(options);
  if (!options.picture.empty()) check_writable(options.picture);
  if (options.report || !options.picture.empty()) warn_of_plotter();
  MissionInput input = load_input(options);
  check_simulation(input.source, options.simulation, !options.link.empty());
  check_live(options.live, input.source, options.simulation.scenario);
  const std::vector<std::filesystem::path> recordings = recordings_of(options, input.source);
  std::optional<OutputFolder> store;  // is made, and can be written
  if (!options.simulation.store.empty()) store.emplace(options.simulation.store);
  const RunSignatures signatures(options);
  const std::unique_ptr<posix::PosixLink> link = open_link(options);
  const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
  for (const std::string& warning : warnings_for(mission.source, options.simulation.scenario))
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  SimulationOptions simulation = options.simulation;
  if (link) tell_address(*link);
  simulation.make_stereo = stereo_for(mission, simulation);
  simulation.link = link.get();
  simulation.authenticator = signatures.check.get();
  simulation.sign_image = signatures.sign;
  const std::unique_ptr<RunRecorders> recorders = open_recorders(options, recordings, mission, link.get(), signatures.before.number);
  if (recorders) simulation.recorders = recorders->cases();
  LiveRun live(options.live, mission.source.name + ", scenario " + simulation.scenario, playback_of(simulation, mission.source));
  simulation.listener = live.listener(mission, simulation.scenario);
  SimulationResult result = simulate(mission, simulation);
  live.end();
  if (recorders) recorders->close(image_bytes(mission, result.tables[0].variants[0].parameters));
  result.sensor = options.sensor;
  result.commit = kCommit;
  write_results(result, folder);
  if (!options.junit.empty()) write_file(options.junit, run_junit_xml(result, required));
  if (simulation.replay) warn_of_replay(result);
  std::fputs(summary_text(result).c_str(), stdout);
  std::printf("written to %s: results.json, frames.csv, telemetry.ccsds%s\n", options.out.c_str(),
              result.relative.empty() ? "" : ", relative.csv");
  for (const std::filesystem::path& file : recordings) std::printf("the recording: %s\n", file.c_str());
  (void)std::fflush(stdout);
  if (options.report || !options.picture.empty()) write_pictures(options.report, options.picture, mission, result, folder);
}

// The head and the line, or the recording, that --sensor names; none: simulated.
struct Wire {
  std::optional<lcs::Device> head;
  std::string line;
  std::string recording;
};

std::optional<Wire> wire_of(const std::string& sensor) {
  if (sensor == "simulated") return Wire{};
  if (sensor.rfind(kReplay, 0) == 0 && sensor.size() > sizeof kReplay - 1) return Wire{std::nullopt, "", sensor.substr(sizeof kReplay - 1)};
  for (const lcs::Device device : {lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar}) {
    const std::string name = wire_name(device);
    if (sensor == name) return Wire{device, "", ""};
    if (sensor.rfind(name + ":", 0) == 0 && sensor.size() > name.size() + 1) return Wire{device, sensor.substr(name.size() + 1), ""};
  }
  return std::nullopt;
}

std::string check_sensor(const std::string& name) {
  return wire_of(name) ? "" : "expected simulated, or lcs-wire, lidar-wire or tridar-wire, or one of these with :LINE, or replay:FILE";
}

// What a recording's sensors gave.
std::shared_ptr<const sim::SensorRecording> recorded_scans(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".3dlr")
    throw InputError("--sensor replay:" + file + ": recordings are FILE.mcap now: record the run again with --record");
  return std::make_shared<const sim::SensorRecording>(read_recorded_run(file).scans);
}

// What the words about cameras ask for. Throws where they do not fit together.
void set_cameras(RunArguments& options) {
  SimulationOptions& simulation = options.simulation;
  const Wire wire = wire_of(options.sensor).value_or(Wire{});
  simulation.wire = wire.head;
  simulation.camera_line = wire.line;
  if (!wire.recording.empty()) simulation.replay = recorded_scans(wire.recording);
  check_record(options.record);
  simulation.plain = !wire.line.empty() || simulation.replay || !options.record.empty() || options.live.address.has_value();
  const bool calibrated = !options.optics.empty() || !options.calibration.empty();
  if (calibrated && (!wire.head || wire.head == lcs::Device::kLidar))
    throw InputError("--camera-optics, --calibration: only a camera on its line has them: add --sensor lcs-wire or tridar-wire");
  if (!options.camera_faults.empty() && (!wire.head || !wire.line.empty()))
    throw InputError("--camera-faults: only a camera on its line fails by a script: add --sensor lcs-wire");
  if (!options.optics.empty()) simulation.camera_optics = load_calibration(options.optics);
  if (!options.calibration.empty()) simulation.calibration = load_calibration(options.calibration);
  if (!options.camera_faults.empty()) simulation.camera_faults = load_camera_faults(options.camera_faults);
}

using SharedArguments = std::shared_ptr<RunArguments>;

void add_sensor_options(CLI::App* command, const SharedArguments& options) {
  command
      ->add_option("--sensor", options->sensor,
                   "simulated, or lcs-wire: laser cameras are reached over their serial line, byte by byte (docs/icd/lcs.md); lidar-wire: "
                   "LIDARs are; "
                   "tridar-wire: each sensor is a TriDAR on its line. With :LINE after it the one at the end of a line of this machine, in "
                   "real time "
                   "(tcp://127.0.0.1:PORT, unix:PATH, or a device). replay:FILE.mcap: the sensors play those of a recording")
      ->capture_default_str()
      ->check(CLI::Validator(check_sensor, ""));
  command
      ->add_option_function<std::string>(
          "--record-sensor",
          [](const std::string& file) {
            throw InputError("--record-sensor " + file + ": is --record FILE.mcap now, which holds what the sensors gave");
          })
      ->group("");
  command->add_flag("--remote", options->simulation.remote_line,
                    "the line may lead to other machines, and a --link without --key be reached from them");
  command->add_option("--camera-faults", options->camera_faults,
                      "script of what goes wrong with laser cameras and their lines (docs/user-guide.md); with --sensor lcs-wire");
  command->add_option("--camera-optics", options->optics,
                      "what the simulated laser camera's optics are (a calibration file; otherwise as the mission's calibration says); "
                      "with --sensor lcs-wire");
  command->add_option("--calibration", options->calibration,
                      "in the mission image: what mdat calibrate wrote (the mission's sensor.calibration)");
  command->add_option("--camera-temperature", options->simulation.camera_degC, "of the simulated camera, degC")
      ->capture_default_str()
      ->check(number_between(-50.0, 100.0));
}

void add_link_options(CLI::App* command, const SharedArguments& options) {
  command->add_option(
      "--link", options->link,
      "udp://[HOST]:PORT, tcp://[HOST]:PORT or file://PATH: run the first range at the clock's pace, commanded over this link "
      "(mdat command --to), until its frames are flown or Ctrl-C ends it; without a host by the loopback address");
  command
      ->add_option("--telemetry-to", options->told,
                   "with --link udp://...: HOST:PORT that telemetry goes to from the beginning, besides those who command")
      ->needs("--link");
  add_apid(*command, options->simulation.apid);
  command
      ->add_option("--key", options->key,
                   "with --link: file with the master key (64 hexadecimal digits); commands and images that are not signed with it are "
                   "refused (mdat command --key, mdat mission sign)")
      ->needs("--link");
  command
      ->add_option(
          "--store", options->simulation.store,
          "with --link: folder of the component's non-volatile store (made where it is missing); an image that was confirmed there "
          "is what the run starts with")
      ->needs("--link");
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<RunArguments>();
  options->simulation.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command = app.add_subcommand("run", "track a mission's target in simulation, and report");
  command->add_option("MISSION", options->mission, "mission file")->required();
  command->add_option("--scenario", options->simulation.scenario, "scenario of the mission")->capture_default_str();
  command->add_option("--seed", options->simulation.seed, "start of the random numbers (the scenario's)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4294967295}));
  add_sensor_options(command, options);
  command->add_option("-o,--out", options->out, "folder to write")->capture_default_str();
  command->add_option("--frames", options->simulation.frames, "frames of each range (the scenario's)")->check(CLI::Range(1, 1000000));
  command->add_option("-j,--jobs", options->simulation.jobs, "ranges and variants at a time; no effect on the results")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  add_link_options(command, options);
  add_live_options(*command, options->live);
  add_settings(*command, options->settings);
  command->add_flag("--force", options->force, "replace what an earlier run left in the folder, and files that are there");
  add_no_cache(*command, options->cached);
  command->add_flag("!--no-report", options->report, "leave report.html out");
  command->add_option("--picture", options->picture, "also write the scan on the target as a PNG picture");
  command->add_option("--junit", options->junit,
                      "file to write for continuous integration: a JUnit test case for each criterion and run (docs/user-guide.md)");
  command
      ->add_option("--require", options->required, "with --junit: one more criterion, such as 'p95_mm <= 5'; may be given again and again")
      ->needs("--junit")
      ->allow_extra_args(false);
  command->add_option("--record", options->record,
                      "FILE.mcap: also record all frames, for viewers and replay (docs/recordings.md); of several ranges a file each "
                      "(FILE-4m.mcap)");
  command
      ->add_option("--record-for", options->record_for,
                   "viewers: all; replay: only what mdat replay needs; iterations: all, and each step of the registrations")
      ->needs("--record")
      ->check(CLI::IsMember({"viewers", "replay", "iterations"}))
      ->capture_default_str();
  command->callback([options] {
    set_cameras(*options);
    run(*options);
  });
}

}  // namespace lasso::mdat
