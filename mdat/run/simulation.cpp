#include "mdat/run/simulation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <numeric>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/modelc/image_writer.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/case_pool.hpp"

namespace lasso::mdat {
namespace {

constexpr double kAimedShare = 0.3;
constexpr double kEdgeOn_rad = 10.001 * kRadPerDeg;

constexpr Variant kNoisy = {"noisy", "with noise", true, true, false};
constexpr Variant kNoiseFree = {"noise_free", "no noise", false, true, false};
constexpr Variant kPaperVariants[] = {kNoiseFree,
                                      kNoisy,
                                      {"noise_free_hits_only", "no noise, hits only", false, false, false},
                                      {"noisy_hits_only", "with noise, hits only", true, false, false},
                                      {"noisy_aimed", "with noise, aimed rays", true, true, true}};

std::vector<std::string> part_names(const MissionSource& source) {
  std::vector<std::string> names{"whole"};
  for (const PartSource& part : source.parts) names.push_back(part.name);
  return names;
}

// More runs than one are asked for.
void refuse_what_serves_one(const SimulationOptions& options) {
  const std::string way_out = ": choose a scenario of one range, such as spin";
  if (!options.camera_line.empty())
    throw InputError("--sensor " + std::string(wire_name(options.wire.value_or(lcs::Device::kLaserCamera))) + ":" + options.camera_line +
                     ": one camera takes the scans of one run" + way_out);
  if (options.replay) throw InputError("--sensor replay: a recording has the scans of one run" + way_out);
}

// What is to be on a line has to be in the mission.
void require_wired(const MissionSource& source, const SimulationOptions& options) {
  if (!options.wire) return;
  std::size_t heads = wired(*options.wire, source.sensor) ? 1 : 0;
  for (const FurtherSensor& sensor : source.further_sensors) {
    if (wired(*options.wire, sensor.kind)) ++heads;
  }
  if (heads > 1 && !options.camera_line.empty()) {
    throw InputError(
        "--sensor " + std::string(wire_name(*options.wire)) + ":" + options.camera_line + ": " + std::to_string(heads) +
        " of the mission's sensors would be at the end of one line: name a kind of which the mission has one (lcs-wire: a laser "
        "camera, lidar-wire: a LIDAR), or leave out the line");
  }
  if (heads > 0) return;
  throw InputError("--sensor " + std::string(wire_name(*options.wire)) + ": none of the mission's sensors is a " +
                   (*options.wire == lcs::Device::kLidar ? "LIDAR (kind = \"time_of_flight\")" : "laser camera (kind = \"laser_camera\")") +
                   "; tridar-wire takes either");
}

// Tells each of two, where they are, in their order.
class BothListeners final : public RunListener {
 public:
  BothListeners(RunListener* first, RunListener* second) : listeners_{first, second} {}
  void on_packets(TimeUs boundary_us, ConstBytes packets) override {
    for (RunListener* listener : listeners_) {
      if (listener != nullptr) listener->on_packets(boundary_us, packets);
    }
  }
  void on_frame(const FlownFrame& frame) override {
    for (RunListener* listener : listeners_) {
      if (listener != nullptr) listener->on_frame(frame);
    }
  }
  void on_commands(TimeUs slot_us, ConstBytes bytes) override {
    for (RunListener* listener : listeners_) {
      if (listener != nullptr) listener->on_commands(slot_us, bytes);
    }
  }
  void on_pair(const TakenPair& pair) override {
    for (RunListener* listener : listeners_) {
      if (listener != nullptr) listener->on_pair(pair);
    }
  }

 private:
  std::array<RunListener*, 2> listeners_;
};

// One image for each set of parameters, and all cases in order.
struct Plan {
  std::vector<std::vector<std::uint8_t>> images;
  std::vector<CaseSetup> cases;
};

std::vector<Variant> variants_of(const Scenario& scenario, const MissionParameters& parameters, bool plain) {
  if (scenario.variants != 0 && !plain) return {std::begin(kPaperVariants), std::end(kPaperVariants)};
  Variant variant = scenario.noise != 0 ? kNoisy : kNoiseFree;
  variant.silhouettes = parameters.silhouettes != 0;
  return {variant};
}

MissionParameters variant_parameters(const Scenario& scenario, MissionParameters parameters, const Variant& variant) {
  parameters.silhouettes = variant.silhouettes ? 1 : 0;
  if (variant.aimed) parameters.aimed_share = std::max(parameters.aimed_share, kAimedShare);
  if (scenario.prior == 0) parameters.initial_present = 0;
  return parameters;
}

std::vector<TableResult> make_tables(const Scenario& scenario, const MissionParameters& parameters, bool plain) {
  std::vector<TableResult> tables(1);
  tables[0].scenario = scenario;
  if (scenario.variants != 0 && scenario.tilt_rad != 0 && !plain) {
    tables.push_back(tables[0]);
    tables[1].name = "side_on";
    tables[1].scenario.tilt_rad = 0;
  }
  for (TableResult& table : tables) {
    for (const Variant& variant : variants_of(scenario, parameters, plain)) {
      VariantResult result;
      result.variant = variant;
      result.parameters = variant_parameters(scenario, parameters, variant);
      table.variants.push_back(std::move(result));
    }
  }
  return tables;
}

// `linked`: an operator commands the run, which is one case then.
std::vector<TableResult> tables_of(const MissionSource& source, const SimulationOptions& options, bool linked) {
  const Scenario& scenario = scenario_of(source, options.scenario);
  std::vector<TableResult> tables = make_tables(scenario, parameters_for(source, options.scenario), options.plain || linked);
  if (linked && !scenario.has_profile()) tables[0].scenario.ranges_m.resize(1);
  if (options.range && !scenario.has_profile()) tables[0].scenario.ranges_m = {scenario.runs_m().at(*options.range)};
  return tables;
}

std::size_t case_count(const std::vector<TableResult>& tables) {
  std::size_t count = 0;
  for (const TableResult& table : tables) count += table.variants.size() * table.scenario.runs_m().size();
  return count;
}

// Noise with and without silhouettes is the same for the same range.
std::uint64_t case_seed(std::uint64_t seed, std::size_t table, std::size_t range) {
  std::uint64_t state = seed ^ (std::uint64_t{table} << 40) ^ (std::uint64_t{range} << 48);
  return sim::split_mix64(state);
}

std::vector<std::uint32_t> all_frames(std::uint32_t frames) {
  std::vector<std::uint32_t> result(frames);
  std::iota(result.begin(), result.end(), 0U);
  return result;
}

CaseSetup make_case(const SimulationResult& result, const TableResult& table, const VariantResult& variant, std::size_t range) {
  CaseSetup setup;
  setup.scenario = table.scenario;
  setup.range_m = table.scenario.runs_m()[range];
  setup.noise = variant.variant.noise;
  setup.frames = result.frames;
  setup.parameters = variant.parameters;
  if (range == shown_range(table.scenario)) setup.keep_frames = shown_frames(table.scenario, result.frames);
  return setup;
}

// `first`: what is the scenario's number of the first range here. `image`: that of each case, or null. `sign`: see SimulationOptions.
Plan make_plan(const CompiledMission& mission, SimulationResult& result, const sim::RayCaster& target, std::size_t first,
               const std::vector<std::uint8_t>* image, const SignImage& sign) {
  Plan plan;
  std::size_t count = 0;
  for (const TableResult& table : result.tables) count += table.variants.size();
  plan.images.reserve(count);  // cases point into it
  for (std::size_t t = 0; t < result.tables.size(); ++t) {
    TableResult& table = result.tables[t];
    for (VariantResult& variant : table.variants) {
      plan.images.push_back(image != nullptr ? *image : image_bytes(mission, variant.parameters));
      if (sign) plan.images.back() = sign(plan.images.back());
      variant.image_crc = LoadedImage("", plan.images.back()).mission().image_crc;
      for (std::size_t range = 0; range < table.scenario.runs_m().size(); ++range) {
        plan.cases.push_back(make_case(result, table, variant, range));
        plan.cases.back().seed = case_seed(result.seed, t, first + range);
        plan.cases.back().scenario = drawn_scenario(plan.cases.back().scenario, plan.cases.back().seed);
        plan.cases.back().others = make_other_bodies(plan.cases.back().scenario, kEpochUs);
        plan.cases.back().image = &plan.images.back();
        plan.cases.back().target = &target;
        plan.cases.back().further_sensors = mission.source.further_sensors;
        plan.cases.back().sensor = mission.source.sensor;
        plan.cases.back().flash = mission.source.flash;
      }
    }
  }
  return plan;
}

// In the paper's scenarios the arrays face the sensor in frame 0 and turn by a step from frame to frame.
bool is_edge_on(std::size_t frame, double step_rad) {
  const double half_turns = static_cast<double>(frame) * step_rad / kPi;
  const double off_rad = (half_turns - std::floor(half_turns) - 0.5) * kPi;
  return std::abs(off_rad) < kEdgeOn_rad;
}

void evaluate(const Scenario& scenario, VariantResult& variant) {
  std::vector<FrameError> all, edge_on, all_settled;
  AlertTimes all_alerts;
  for (const CaseResult& result : variant.cases) {
    const std::vector<FrameError> settled = settled_frames(result.frames);
    variant.by_range.push_back(run_statistics(result.frames));
    variant.by_range.back().settled = settled_statistics(settled);
    variant.by_range.back().alert = alert_times(result.frames, result.end_s);
    all_alerts.add(variant.by_range.back().alert);
    all_settled.insert(all_settled.end(), settled.begin(), settled.end());
    all.insert(all.end(), result.frames.begin(), result.frames.end());
    for (std::size_t frame = 0; frame < result.frames.size(); ++frame) {
      if (is_edge_on(frame, scenario.step_rad)) edge_on.push_back(result.frames[frame]);
    }
  }
  variant.all = run_statistics(all);
  variant.all.settled = settled_statistics(all_settled);
  variant.all.alert = all_alerts;
  variant.edge_on = run_statistics(edge_on);
}

void collect(std::vector<CaseResult> cases, SimulationResult& result) {
  std::size_t next = 0;
  for (TableResult& table : result.tables) {
    for (VariantResult& variant : table.variants) {
      for (std::size_t range = 0; range < table.scenario.runs_m().size(); ++range) variant.cases.push_back(std::move(cases[next++]));
      evaluate(table.scenario, variant);
    }
  }
}

}  // namespace

CompiledMission recalibrated(CompiledMission mission, lcs::Device wire, const TriangulationCalibration& calibration) {
  MissionSource& source = mission.source;
  if (wired(wire, source.sensor)) source.calibrations[0] = {calibration};
  std::uint8_t number = 0;
  for (const FurtherSensor& sensor : source.further_sensors) {
    ++number;
    if (wired(wire, sensor.kind)) source.calibrations[number] = {calibration};
  }
  return mission;
}

std::vector<std::string> sensor_names(const MissionSource& source) {
  std::vector<std::string> names{kind_name(source.sensor)};
  for (const FurtherSensor& sensor : source.further_sensors) names.push_back(sensor.name);
  return names;
}

std::vector<std::uint32_t> shown_frames(const Scenario& scenario, std::uint32_t frames) {
  std::vector<std::uint32_t> result;
  if (scenario.has_timeline()) return all_frames(frames);  // which of them, the run itself will tell
  if (scenario.step_rad == 0) return frames > 0 ? std::vector<std::uint32_t>{0} : result;
  for (const double angle_deg : {0.0, 45.0, 90.0}) {
    const double frame = std::round(angle_deg * kRadPerDeg / std::fabs(scenario.step_rad));
    if (frame < frames) result.push_back(static_cast<std::uint32_t>(frame));
  }
  return result;
}

CaseSetup plain_case(const MissionSource& source, const Scenario& scenario, std::uint64_t seed, std::uint32_t frames, std::size_t range) {
  const TableResult table = make_tables(scenario, parameters_for(source, scenario), true).front();
  CaseSetup setup;
  setup.seed = case_seed(seed, 0, range);
  setup.scenario = drawn_scenario(scenario, setup.seed);
  setup.others = make_other_bodies(setup.scenario, kEpochUs);
  setup.range_m = scenario.runs_m().at(range);
  setup.noise = table.variants.front().variant.noise;
  setup.frames = frames;
  setup.parameters = table.variants.front().parameters;
  setup.further_sensors = source.further_sensors;
  setup.sensor = source.sensor;
  setup.flash = source.flash;
  setup.calibrations = source.calibrations;
  return setup;
}

CaseSetup camera_case(const CompiledMission& mission, const SimulationOptions& options, const sim::RayCaster& target) {
  CaseSetup setup;
  setup.scenario = scenario_of(mission.source, options.scenario);
  setup.range_m = setup.scenario.runs_m().front();
  setup.noise = setup.scenario.noise != 0;
  setup.seed = options.seed.value_or(static_cast<std::uint64_t>(setup.scenario.seed));
  setup.scenario = drawn_scenario(setup.scenario, case_seed(setup.seed, 0, 0));
  setup.parameters = parameters_for(mission.source, options.scenario);
  setup.target = &target;
  setup.others = make_other_bodies(setup.scenario, kEpochUs);
  setup.choose(options);
  // The camera that runs alone is the mission's first of its kind.
  const auto first = mission.source.calibrations.begin();
  if (first != mission.source.calibrations.end()) setup.calibrations = {{0, first->second}};
  return setup;
}

void check_simulation(const MissionSource& source, const SimulationOptions& options, bool linked) {
  const std::vector<TableResult> tables = tables_of(source, options, linked);
  require_wired(source, options);
  if (case_count(tables) != 1) refuse_what_serves_one(options);
  check_camera_line(options.wire, options.camera_line, options.remote_line);
}

SimulationResult simulate(const CompiledMission& mission, const SimulationOptions& options) {
  const bool linked = options.link != nullptr || options.commands;
  check_simulation(mission.source, options, linked);
  const Scenario& scenario = scenario_of(mission.source, options.scenario);
  SimulationResult result;
  result.mission = mission.source.name;
  result.scenario = options.scenario;
  result.seed = options.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  result.frames = options.frames.value_or(static_cast<std::uint32_t>(scenario.frames));
  result.settings = mission.source.settings;
  result.values = effective_values(mission.source, options.scenario);
  result.deviations = deviations(mission.source, options.scenario);
  result.sensors = sensor_names(mission.source);
  result.camera_faults = options.camera_faults;
  result.parts = part_names(mission.source);
  result.tables = tables_of(mission.source, options, linked);

  const auto begin = std::chrono::steady_clock::now();
  const std::unique_ptr<sim::RayCaster> target = simulated_target(mission.mesh, scenario, result.seed, mission.source.target_laser);
  std::optional<CompiledMission> changed;
  if (options.calibration && options.wire) changed = recalibrated(mission, *options.wire, *options.calibration);
  Plan plan = make_plan(changed ? *changed : mission, result, *target, options.range.value_or(0), options.image, options.sign_image);
  for (CaseSetup& setup : plan.cases) {
    setup.choose(options);
    setup.calibrations = mission.source.calibrations;  // of the cameras as they are, whatever the image says
  }
  for (std::size_t i = 0; i < options.recorders.size(); ++i) {
    plan.cases.at(i).record = options.recorders[i].record;
    plan.cases.at(i).listener = options.recorders[i].listener;
  }
  BothListeners both(plan.cases.front().listener, options.listener);
  if (options.listener != nullptr) plan.cases.front().listener = &both;
  ProgressBar bar("track", plan.cases.size() * result.frames, "frames");
  collect(run_cases(plan.cases, options.jobs, bar), result);
  bar.finish();
  const CaseResult& first = result.tables.front().variants.front().cases.front();
  result.frames = std::min(result.frames, first.flown);
  if (scenario.scene != nullptr) result.relative = relative_runs(*scenario.scene, first.telemetry);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::string telemetry_bytes(const SimulationResult& result) {
  std::string bytes;
  for (const TableResult& table : result.tables) {
    for (const VariantResult& variant : table.variants) {
      for (const CaseResult& run : variant.cases) bytes.append(run.telemetry.begin(), run.telemetry.end());
    }
  }
  return bytes;
}

}  // namespace lasso::mdat
