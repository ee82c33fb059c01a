// A whole scenario: its tables, variants and ranges as independent cases, run on all cores, and their statistics.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/relative_poses.hpp"
#include "mdat/run/true_target.hpp"

namespace lasso::mdat {

using SignImage = std::function<std::vector<std::uint8_t>(const std::vector<std::uint8_t>&)>;

// Of one case alone: a replay, a camera's line, a link or commands.
struct SimulationOptions : CaseOptions {
  std::string scenario = "paper";
  std::optional<std::uint64_t> seed;    // otherwise the scenario's
  std::optional<std::uint32_t> frames;  // otherwise the scenario's
  unsigned jobs = 1;                    // cases at a time; the results do not depend on it
  std::optional<std::size_t> range;     // this one of the scenario's alone, as it flies among the others
  // What keeps each case, where it is recorded: as many as the scenario, as it stands, has ranges.
  struct CaseRecorder {
    std::shared_ptr<sim::SensorRecording> record;  // as CaseSetup's
    RunListener* listener = nullptr;
  };
  std::vector<CaseRecorder> recorders;
  RunListener* listener = nullptr;                      // to the first case, besides its recorder
  std::optional<TriangulationCalibration> calibration;  // in the image, instead of the mission's
  SignImage sign_image;                                 // as the authenticator wants the first image; empty: as it is
  const std::vector<std::uint8_t>* image =
      nullptr;         // that flies instead of the mission's, of the same period; the world stays the mission's
  bool plain = false;  // the scenario as it stands: one table, one variant
};

// What a table compares. In the noise-free variants the estimator keeps the mission's noise model.
struct Variant {
  const char* name;   // key in results.json
  const char* title;  // for people
  bool noise;
  bool silhouettes;
  bool aimed;  // kAimedShare of the rays leave the pattern for contours, or more if the mission says so
};

struct VariantResult {
  Variant variant{};
  MissionParameters parameters{};
  std::uint32_t image_crc = 0;    // of the flight image
  std::vector<CaseResult> cases;  // one a range
  std::vector<RunStatistics> by_range;
  RunStatistics all;
  RunStatistics edge_on;  // of the views in which the arrays are within 10 degrees of being seen edge-on; the paper's scenarios only
};

struct TableResult {
  std::string name;  // "" the scenario itself, "side_on" the same without tilt
  Scenario scenario;
  std::vector<VariantResult> variants;
};

struct SimulationResult {
  std::string mission, scenario;
  std::uint64_t seed = 0;
  std::uint32_t frames = 0;
  sim::LcsFaults camera_faults;
  std::string sensor = "simulated";         // or as --sensor names it
  std::string commit;                       // of the program
  std::vector<std::string> settings;        // KEY=VALUE of the command line
  std::vector<EffectiveValue> values;       // that held
  std::vector<Deviation> deviations;        // of them, those that are not presets, and what is stated of lasers
  std::vector<std::string> sensors, parts;  // names by their numbers; part 0 is the whole
  std::vector<TableResult> tables;
  std::vector<RelativeRun> relative;  // of a scene
  double seconds = 0;

  const Scenario& flown() const { return tables.front().scenario; }
};

// The case that a scenario's camera is in, for whoever runs it alone: its first range, with noise as the scenario says. `target` outlives
// it.
CaseSetup camera_case(const CompiledMission& mission, const SimulationOptions& options, const sim::RayCaster& target);

// The case of a scenario's range (index into runs_m) as it stands (SimulationOptions::plain), as simulate runs it, for whoever runs one or
// many: the caller sets image, of these parameters, and target.
CaseSetup plain_case(const MissionSource& source, const Scenario& scenario, std::uint64_t seed, std::uint32_t frames,
                     std::size_t range = 0);

// The mission with another calibration of each head that is on a line.
CompiledMission recalibrated(CompiledMission mission, lcs::Device wire, const TriangulationCalibration& calibration);

// Names of the mission's sensors by their numbers; [sensor], which has none, by its kind.
std::vector<std::string> sensor_names(const MissionSource& source);

// What of a simulation the mission, or this machine, does not have, before anything is compiled: the scenario, a sensor, a line; and what
// serves one run, where there are several. `linked`: there will be a link. Throws InputError or MissionError.
void check_simulation(const MissionSource& source, const SimulationOptions& options, bool linked);

// A scenario with `variants` is flown in all of them (noise x silhouettes, and aimed rays), with a second table without tilt where it has
// one; any other in the one that it states.
// Checks first (check_simulation). Throws InputError, MissionError or RunError.
SimulationResult simulate(const CompiledMission& mission, const SimulationOptions& options);

// All packets, in the order of tables, variants and ranges.
std::string telemetry_bytes(const SimulationResult& result);

// Index of the range whose scans the report shows: the middle one.
inline std::size_t shown_range(const Scenario& scenario) { return scenario.runs_m().size() / 2; }
// The frames whose scans are kept for the report: at 0, 45 and 90 degrees; all where the target moves through a profile of ranges.
std::vector<std::uint32_t> shown_frames(const Scenario& scenario, std::uint32_t frames);

}  // namespace lasso::mdat
