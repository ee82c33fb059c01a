// mdat replay of a recording: the component flies again on what its sensors and its operator gave, as it was, or changed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/cli/live_run.hpp"
#include "mdat/cli/recorded_flight.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/upload.hpp"
#include "mdat/recording/background_recorder.hpp"
#include "mdat/run/flight_figures.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

ConstBytes bytes_of(const std::string& text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

bool is_changed(const RecordedReplay& options) { return !options.settings.empty() || !options.mission.empty() || !options.image.empty(); }

// What is asked for does not go together, or cannot be written. Throws InputError.
void check_asked(const RecordedReplay& options) {
  if (!options.image.empty() && !options.mission.empty())
    throw InputError("--image " + options.image + ": --mission has an image of its own: give one of them");
  if (!options.image.empty() && !options.settings.empty())
    throw InputError("--set " + options.settings.front() + ": the values of --image " + options.image + " are fixed; give its --mission");
  if (options.record.empty()) return;
  if (std::filesystem::path(options.record).extension() != ".mcap") throw InputError("--record " + options.record + ": expected FILE.mcap");
  refuse_same_files({options.record}, {options.file, options.mission, options.image, options.key});
  if (!options.force) refuse_to_replace({options.record}, "--force replaces it");
  check_writable(options.record);
}

// What flies instead of the recorded component: its image, and the mission of which that is, if any.
struct ChangedComponent {
  std::vector<std::uint8_t> image;
  std::unique_ptr<CompiledMission> mission;
};

// By the scenario of the run, where the mission has one of that name; with the start that the recorded run had.
std::vector<std::uint8_t> image_for(const CompiledMission& mission, const RecordedFlight& flight, const Scenario& flown) {
  const std::string& name = flight.options().scenario;
  const bool has_it = mission.source.scenarios.count(name) > 0;
  MissionParameters parameters = has_it ? parameters_for(mission.source, name) : mission.source.parameters;
  if (flown.prior == 0) parameters.initial_present = 0;
  return image_bytes(mission, parameters);
}

MissionInput changed_input(const RecordedReplay& options, const RecordedFlight& flight) {
  const std::string& scenario = flight.options().scenario;
  if (!options.mission.empty()) {
    const bool has_it = load_mission_input(options.mission).source.scenarios.count(scenario) > 0;
    return load_mission_input(options.mission, options.settings, has_it ? scenario : "");
  }
  std::vector<std::string> settings = flight.changed_settings();
  if (!flight.image().empty() && settings.empty())
    throw InputError("--set " + options.settings.front() + ": the image of " + flight.file() +
                     " is not that of its mission, and its values are fixed; give --mission");
  settings.insert(settings.end(), options.settings.begin(), options.settings.end());
  return flight.mission(settings);
}

ChangedComponent changed_component(const RecordedReplay& options, const RecordedFlight& flight, const Scenario& flown) {
  ChangedComponent component;
  if (!options.image.empty()) {
    component.image = read_bytes(options.image);
    return component;
  }
  MissionInput input = changed_input(options, flight);
  tell_idle_settings(input.source, flight.options().scenario);
  component.mission = std::make_unique<CompiledMission>(compile_mission(std::move(input), ModelCache::of_user_if(options.cached)));
  const SimulationOptions& as_flown = flight.options();
  if (as_flown.calibration && as_flown.wire) *component.mission = recalibrated(*component.mission, *as_flown.wire, *as_flown.calibration);
  component.image = image_for(*component.mission, flight, flown);
  return component;
}

// The recorded world, with the target as the changed component knows it.
CompiledMission seen_by(const ChangedComponent& component, CompiledMission mission) {
  if (component.mission) mission.mesh = component.mission->mesh;
  if (component.mission) mission.source.parts = component.mission->source.parts;
  return mission;
}

// Recorded scans come at the period of their run.
void check_period(const RecordedReplay& options, const std::vector<std::uint8_t>& image, double period_s) {
  const std::string name = options.image.empty() ? (options.mission.empty() ? options.file : options.mission) : options.image;
  const LoadedImage loaded(name, image);
  const double now_s = loaded.mission().parameters.period_s;
  if (to_us(now_s) == to_us(period_s)) return;
  char text[120];
  (void)std::snprintf(text, sizeof text, ": filter.period_s is %g s, and the recorded scans come every %g s: it has to be the same", now_s,
                      period_s);
  throw InputError(name + text);
}

// Of another mission: its component asks for sensors that the run did not have.
void check_sensors(const RecordedReplay& options, const ChangedComponent& component, const CompiledMission& mission) {
  if (!component.mission) return;
  const std::size_t now = 1 + component.mission->source.further_sensors.size(), then = 1 + mission.source.further_sensors.size();
  if (now <= then) return;
  throw InputError((options.mission.empty() ? options.file : options.mission) + ": has " + std::to_string(now) +
                   " sensors, and the recording the scans of " + std::to_string(then) + ": leave the others out ([further_sensor.NAME])");
}

// What made the image: for who opens the recording of the replay.
void tell_change(const RecordedReplay& options, const RecordedFlight& flight, mcap::Text& about) {
  if (!is_changed(options)) return;
  about[kFlownImage] = kAttachedImage;
  std::vector<std::string> settings =
      options.mission.empty() && options.image.empty() ? flight.changed_settings() : std::vector<std::string>();
  settings.insert(settings.end(), options.settings.begin(), options.settings.end());
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : "\n") + setting;
  const std::string other = options.image.empty() ? options.mission : options.image;
  about.erase(kChangedSettings);
  about.erase(kChangedBy);
  if (other.empty()) about[kChangedSettings] = text;
  if (!other.empty()) about[kChangedBy] = other + (text.empty() ? "" : "\n" + text);
}

// The run's own files, what was said of it, and what is another now.
RecordingHead replayed_head(const RecordedReplay& options, const RecordedFlight& flight) {
  RecordingHead head{flight.run().about, flight.run().files};
  head.files.erase(kImageAttachment);
  head.about.erase(kWholeUntil);
  head.about["commit"] = kCommit;
  head.about["frames"] = std::to_string(flight.options().frames.value_or(1));
  tell_change(options, flight, head.about);
  return head;
}

SimulationResult recorded_again(const RecordedReplay& options, const RecordedFlight& flight, const CompiledMission& mission,
                                const CompiledMission& seen, SimulationOptions simulation) {
  if (options.record.empty()) return simulate(mission, simulation);
  const auto scans = std::make_shared<sim::SensorRecording>();
  BackgroundRecorder recorder(options.record, seen, replayed_head(options, flight), scans);
  simulation.recorders = {{scans, &recorder}};
  SimulationResult result = simulate(mission, simulation);
  const std::vector<std::uint8_t> of_mission = image_bytes(mission, result.tables[0].variants[0].parameters);
  recorder.close(simulation.image != nullptr ? *simulation.image : of_mission);
  return result;
}

// `image`: of a changed component, else null. Viewers are told of what the component sees.
SimulationResult flown_again(const RecordedReplay& options, const LiveOptions& told, const RecordedFlight& flight,
                             const CompiledMission& mission, const CompiledMission& seen, const std::vector<std::uint8_t>* image) {
  SimulationOptions simulation = flight.options();
  if (image != nullptr) simulation.image = image;
  const double period_s = parameters_for(mission.source, simulation.scenario).period_s;
  LiveRun live(told, "replay of " + flight.file(), playback_range(simulation.frames.value_or(1), period_s));
  simulation.listener = live.listener(seen, simulation.scenario);
  SimulationResult result = recorded_again(options, flight, mission, seen, std::move(simulation));
  live.end();
  return result;
}

// The first byte that differs; empty where all are the same.
std::string difference(const std::string& now, const std::string& then) {
  if (now == then) return "";
  const auto at = std::mismatch(now.begin(), now.end(), then.begin(), then.end()).first - now.begin();
  return "from byte " + std::to_string(at) + " on, of " + std::to_string(then.size()) + " recorded and " + std::to_string(now.size()) +
         " now";
}

// A replay has to give the recorded telemetry, of a part of a recording as far as that is whole. Throws RunError where it does not.
void tell_comparison(const RecordedFlight& flight, std::string now) {
  now.resize(flight.comparable_bytes(now.size()));
  const std::string differs = difference(now, flight.run().telemetry);
  if (differs.empty()) std::printf("telemetry: the same as recorded, %zu bytes\n", now.size());
  if (differs.empty()) return;
  std::printf("telemetry: another than recorded, %s\n", differs.c_str());
  const auto commit = flight.run().about.find("commit");
  throw RunError(flight.file() + ": replayed by another program than recorded it (commit " +
                 (commit != flight.run().about.end() ? commit->second : "unknown") + "), or not to be repeated");
}

// T_sensor_target of the recorded run; empty where nobody knows it.
TruthAt recorded_truth(const RecordedFlight& flight, const CompiledMission& mission) {
  if (!flight.knows_truth()) return {};
  const SimulationOptions& options = flight.options();
  const CaseSetup setup = plain_case(mission.source, scenario_of(mission.source, options.scenario), options.seed.value_or(0),
                                     options.frames.value_or(1), options.range.value_or(0));
  const std::shared_ptr<sim::Trajectory> target = make_trajectory(setup.scenario, setup.range_m, kEpochUs, period_us(setup.parameters));
  return [target](TimeUs t_us) { return target->at(t_us).T_sensor_target; };
}

void tell_side_by_side(const RecordedFlight& flight, const CompiledMission& mission, const SimulationResult& result) {
  const TruthAt truth = recorded_truth(flight, mission);
  std::string now = telemetry_bytes(result);
  const std::vector<PoseTelemetry> before = poses_in(bytes_of(flight.run().telemetry));
  std::vector<PoseTelemetry> after = poses_in(bytes_of(now));
  if (!flight.run().whole) after.resize(std::min(after.size(), before.size()));
  std::fputs(side_by_side("recorded", flight_figures(before, truth), "changed", flight_figures(after, truth)).c_str(), stdout);
  const std::optional<TimeUs> first = first_difference(before, after);
  if (!first) std::printf("no pose differs\n");
  if (first) {
    const double period_s = result.tables[0].variants[0].parameters.period_s;
    std::printf("the first pose that differs: at %.3f s, frame %.0f\n", to_seconds(*first),
                std::floor(to_seconds(*first - kEpochUs) / period_s));
  }
}

// Scans that a changed component asks for elsewhere, or otherwise.
void warn_of_unserved(const RecordedFlight& flight, const SimulationResult& result) {
  const CaseResult& run = result.tables[0].variants[0].cases[0];
  if (run.replay_unserved == 0) return;
  std::fprintf(stderr,
               "warning: %s: %u scans that the changed component asked for are not in the recording, and were lost: it plans others, or "
               "looks elsewhere\n",
               flight.file().c_str(), run.replay_unserved);
}

void warn_of_same_image(const RecordedFlight& flight, const std::vector<std::uint8_t>& image) {
  const auto recorded = flight.run().files.find(kImageAttachment);
  if (recorded == flight.run().files.end() || recorded->second != std::string(image.begin(), image.end())) return;
  std::fprintf(stderr,
               "warning: %s: the flight image is the recorded one: what was changed is of the simulated world, which a recording does not "
               "ask again\n",
               flight.file().c_str());
}

// A component with a store, or one that was uploaded to, may fly another image than the changed one.
void warn_of_other_image(const RecordedFlight& flight, const SimulationResult& result, const std::vector<std::uint8_t>& image) {
  const std::string telemetry = telemetry_bytes(result);
  const std::vector<PoseTelemetry> poses = poses_in(bytes_of(telemetry));
  const std::uint32_t changed = image_crc(image);
  const auto other = [changed](const PoseTelemetry& pose) { return pose.image_crc != changed; };
  const auto frames = static_cast<std::size_t>(std::count_if(poses.begin(), poses.end(), other));
  if (frames == 0) return;
  std::fprintf(
      stderr,
      "warning: %s: %zu of %zu frames flew another image than the changed one (%08x): one that the component's store holds, or that "
      "was uploaded\n",
      flight.file().c_str(), frames, poses.size(), changed);
}

}  // namespace

void replay_recording(const RecordedReplay& options, const LiveOptions& live) {
  check_asked(options);
  RecordedFlight flight(options.file, options.key);
  MissionInput input = flight.mission();
  flight.limit_to_recorded(input);
  check_simulation(input.source, flight.options(), flight.options().commands != nullptr);
  const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
  if (!is_changed(options)) {
    const SimulationResult same = flown_again(options, live, flight, mission, mission, nullptr);
    std::fputs(summary_text(same).c_str(), stdout);
    if (!options.record.empty()) std::printf("the recording: %s\n", options.record.c_str());
    return tell_comparison(flight, telemetry_bytes(same));
  }
  const Scenario& flown = scenario_of(mission.source, flight.options().scenario);
  const ChangedComponent component = changed_component(options, flight, flown);
  check_period(options, component.image, parameters_for(mission.source, flight.options().scenario).period_s);
  check_sensors(options, component, mission);
  warn_of_same_image(flight, component.image);
  const SimulationResult changed = flown_again(options, live, flight, mission, seen_by(component, mission), &component.image);
  tell_side_by_side(flight, mission, changed);
  warn_of_unserved(flight, changed);
  warn_of_other_image(flight, changed, component.image);
  if (!options.record.empty()) std::printf("the recording: %s\n", options.record.c_str());
}

}  // namespace lasso::mdat
