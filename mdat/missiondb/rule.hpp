// Rules that the values of a mission keep together: each is a row of a table that says how grave a breach is, which values take part, and
// what is wrong, in words with figures. Inside of missiondb.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// kError: nothing sensible can follow. kWarning: it is doubtful.
enum class Severity : std::uint8_t { kError, kWarning };

// What a rule is asked about, once for each: the mission; its parameters, as they are and as each scenario overrides them; each sensor, by
// itself and in each scenario; each scenario.
enum class Scope : std::uint8_t { kMission, kParameters, kSensor, kScenario };

// What has to be known before it can be asked.
enum class Needs : std::uint8_t { kValues, kTarget };

// The target's box, in its own frame.
struct TargetSize {
  Eigen::Vector3d low, high;
  double longest_m() const { return (high - low).maxCoeff(); }
  double half_m() const { return 0.5 * longest_m(); }
  Eigen::Vector3d middle() const { return 0.5 * (low + high); }
};

struct SensorInUse {
  std::string prefix;  // of its keys
  SensorKind kind = SensorKind::kLaserCamera;
  SensorParameters p{};
  std::vector<double> ranges_m;  // of the scenario's, those at which it takes scans
  sim::FlashModel flash{};       // of a flash LIDAR
};

struct Subject {
  const MissionSource& source;
  MissionParameters p{};                // that hold: with the scenario's overrides
  const Scenario* scenario = nullptr;   // null: the mission by itself
  std::string name;                     // of the scenario
  const SensorInUse* sensor = nullptr;  // Scope::kSensor
  const TargetSize* target = nullptr;   // Needs::kTarget
};

struct Rule {
  Severity severity;
  Scope scope;
  Needs needs;
  std::vector<const char*> keys;         // the first is the one to change; of a sensor as [sensor] has it, of a scenario without its name
  std::string (*fault)(const Subject&);  // empty: the rule is kept
};
using Rules = std::vector<Rule>;

const Rules& scan_rules();        // pattern and search
const Rules& estimation_rules();  // estimation, filter, tracking, start, image
const Rules& sensor_rules();
const Rules& scenario_rules();
const Rules& scene_rules();   // of scenarios that fly the mission's nodes
const Rules& target_rules();  // the model, its parts, and where it is in the field

// Three digits, as a person reads it.
std::string figure(double value);
std::string degrees_text(double rad);  // "3.1 deg"
std::string percent_text(double share);

bool is_in_order(const MissionParameters& p, double source);
constexpr double kNavigationSource = 2, kAprioriSource = 3, kSearchSource = 5;  // positions in the choices of start.first
inline bool checks_starts(const MissionParameters& p) { return p.start_check > 0.5; }

// The target's greatest acceleration over what the filter takes it for: beyond, its track is doubtful.
constexpr double kAccelerations = 5;

// Whether a key of a scenario says what in this one the nodes' motions say.
bool is_of_motion(const Scenario& scenario, const std::string& key);
// Whether it changes anything in this scenario.
bool has_effect(const Scenario& scenario, const std::string& key);

// What a simulated laser camera's detector tells apart, of the square of the range (docs/icd/lcs.md).
constexpr double kCameraCounts_per_m = 2e-5;

// One sigma along the ray of a return from depth z_m.
double range_sigma_m(const SensorParameters& sensor, double z_m);

// The sensors, with the ranges of the scenario (may be null) that are theirs.
std::vector<SensorInUse> sensors_in_use(const MissionSource& source, const MissionParameters& p, const Scenario* scenario);

// Called with the mission by itself and each of its scenarios.
Subject subject_of(const MissionSource& source, const std::string& scenario);

}  // namespace lasso::mdat
