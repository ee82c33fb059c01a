#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/recording/recorded_run.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/results.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {
namespace {

void tell_damage(const std::string& file, const std::vector<mcap::Damage>& damage) {
  for (const mcap::Damage& part : damage)
    std::fprintf(stderr, "warning: %s: damaged at byte %llu: %s\n", file.c_str(), static_cast<unsigned long long>(part.at),
                 part.why.c_str());
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::uint64_t number_of(const std::string& file, const mcap::Text& about, const std::string& key) {
  const auto found = about.find(key);
  const std::string text = found != about.end() ? found->second : "";
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
    throw InputError(file + ": its metadata says no " + key + ": the recording is not whole");
  return std::stoull(text);
}

std::string word_of(const mcap::Text& about, const std::string& key) {
  const auto found = about.find(key);
  return found != about.end() ? found->second : "";
}

// The heads that the run had on lines: the component is told so, and their scans come from the recording.
std::optional<lcs::Device> wire_in(const std::string& sensor) {
  for (const lcs::Device device : {lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar}) {
    if (sensor.rfind(wire_name(device), 0) == 0) return device;
  }
  return std::nullopt;
}

SimulationOptions options_of(const std::string& file, const RecordedRun& run) {
  SimulationOptions options;
  options.scenario = word_of(run.about, "scenario");
  options.seed = number_of(file, run.about, "seed");
  options.frames = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(number_of(file, run.about, "frames"), 1, 1'000'000));
  if (run.about.count("range") > 0) options.range = std::min<std::uint64_t>(number_of(file, run.about, "range"), 1000);
  options.wire = wire_in(word_of(run.about, "sensor"));
  options.replay = std::make_shared<sim::SensorRecording>(run.scans);
  options.plain = true;
  return options;
}

// Frames that are flown for the telemetry of a part of a recording: up to that of its last boundary.
std::uint32_t frames_until(const RecordedRun& run, double period_s) {
  const double frames = std::ceil((1e-9 * static_cast<double>(run.last_packet_ns) - to_seconds(kEpochUs)) / period_s);
  return static_cast<std::uint32_t>(std::clamp(frames, 1.0, 1e6));
}

// The first byte that differs, and its frame; empty where all are the same.
std::string difference(const std::string& now, const std::string& then) {
  if (now == then) return "";
  const auto at = std::mismatch(now.begin(), now.end(), then.begin(), then.end()).first - now.begin();
  return "from byte " + std::to_string(at) + " on, of " + std::to_string(then.size()) + " recorded and " + std::to_string(now.size()) +
         " now";
}

// Without settings of its own, a replay has to give the recorded telemetry, of a part of a recording as far as that is whole. Returns
// whether it did.
bool tell_comparison(std::string now, const RecordedRun& run, bool changed) {
  if (!run.whole) now.resize(std::min(now.size(), run.telemetry.size()));
  const std::string differs = difference(now, run.telemetry);
  if (differs.empty()) std::printf("telemetry: the same as recorded, %zu bytes\n", now.size());
  if (!differs.empty()) std::printf("telemetry: another than recorded, %s%s\n", differs.c_str(), changed ? ", as was to be expected" : "");
  return differs.empty() || changed;
}

}  // namespace

void replay_recording(const std::string& file, const std::vector<std::string>& settings, bool cached) {
  const RecordedRun run = read_recorded_run(file);
  tell_damage(file, run.damage);
  const MissionFolder folder(run);
  SimulationOptions options = options_of(file, run);
  if (run.files.count(kCalibrationAttachment) > 0) options.calibration = load_calibration(folder.file(kCalibrationAttachment));
  std::vector<std::string> all = lines_of(word_of(run.about, "settings"));
  all.insert(all.end(), settings.begin(), settings.end());
  MissionInput input = load_mission_input(folder.mission(), all, options.scenario);
  if (options.range.value_or(0) >= scenario_of(input.source, options.scenario).runs_m().size())
    throw InputError(file + ": is of a range that its scenario does not have: the recording is not whole");
  check_simulation(input.source, options, false);
  if (!run.whole)
    options.frames =
        std::min(options.frames.value_or(UINT32_MAX), frames_until(run, parameters_for(input.source, options.scenario).period_s));
  const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(cached));
  const SimulationResult result = simulate(mission, options);
  std::fputs(summary_text(result).c_str(), stdout);
  const bool as_expected = tell_comparison(telemetry_bytes(result), run, !settings.empty());
  if (!as_expected)
    throw RunError(file + ": replayed by another program than recorded it (commit " + word_of(run.about, "commit") +
                   "), or not to be repeated");
}

void add_recording_command(CLI::App& app) {
  CLI::App* group = app.add_subcommand("recording", "look into recordings (.mcap), cut, mend, merge and export them");
  group->require_subcommand(1);
  CLI::App* info = group->add_subcommand("info", "what a recording holds: its run, topics, attachments, and what is damaged");
  const auto file = std::make_shared<std::string>();
  info->add_option("FILE", *file, "recording (.mcap), of any program")->required();
  info->callback([file] { std::fputs(contents_text(*file).c_str(), stdout); });
  add_recording_edits(group);
}

}  // namespace lasso::mdat
