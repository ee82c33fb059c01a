// A mission as a person writes it: TOML, checked completely, with the origin of every value. Ground only; the flight component sees the
// compiled image. All values here are SI and radians; the files hold the units that their keys name.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fsw/mission/calibration.hpp"
#include "fsw/mission/parameters.hpp"
#include "hal_sim/detector.hpp"
#include "hal_sim/flash_model.hpp"
#include "hal_sim/laser_reflection.hpp"
#include "mdat/missiondb/campaign_source.hpp"
#include "mdat/missiondb/material_source.hpp"
#include "mdat/missiondb/scene_source.hpp"
#include "mdat/missiondb/stereo_source.hpp"
#include "mdat/modelc/mesh.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat {

// Where a value came from: a place in the file, or the command line. Neither: nobody wrote it, `preset` holds.
struct Origin {
  int line = 0, column = 0;
  bool set = false;  // by --set
  bool preset() const { return line == 0 && !set; }
};
constexpr char kSettingPlace[] = "--set";

struct TargetSource {
  std::filesystem::path file;                // resolved; the model's TOML, or the mesh
  bool parametric = false;                   // file is a model (TOML), not a mesh
  std::string file_key;                      // "target.model" or "target.mesh"
  std::string sha256;                        // of the file's bytes as found, lower-case hex
  double scale = 1;                          // applied to the file's lengths to get metres
  std::vector<double> origin_m;              // the target's origin, in the file's axes after scale
  double crease_angle_rad = 0;               // facets that meet at less are one smooth surface
  double cell_size_m = 0;                    // of the look-up field
  std::map<std::string, double> parameters;  // of the parametric model, in the units that the model states; only those that were written
};

// A part of the target with a model of its own: cut from the target by a box, or a file like the target's.
struct PartSource {
  std::string name;
  std::vector<double> box_m;                 // low x, y, z, high x, y, z, target frame; empty: a file
  std::filesystem::path file;                // resolved; empty: a box
  bool parametric = false;                   // file is a model (TOML), not a mesh
  double scale = 1;                          // applied to the file's lengths to get metres
  double cell_size_m = 0;                    // of the look-up field, 0: chosen by the compiler
  std::vector<double> origin_m, quaternion;  // T_target_part: x, y, z; and x, y, z, w, of unit length
  std::vector<double> range_m;               // nearest and farthest of its centre from the sensor
  std::vector<double> view;                  // unit vector in part axes, towards the sensors that see it
  double cone_rad = 0, priority = 1;
};

// How the sensor measures a range. Its presets in [sensor] and of its beam come from the kind (hal_sim/scanner_model.hpp).
enum class SensorKind : std::uint8_t { kLaserCamera = 0, kTimeOfFlight = 1, kFlashLidar = 2, kStereo = 3 };
constexpr const char* kSensorKindNames[] = {"laser_camera", "time_of_flight", "flash_lidar", "stereo"};  // as a mission writes them
inline const char* kind_name(SensorKind kind) { return kSensorKindNames[static_cast<int>(kind)]; }

// Of a sensor's laser, for people's safety (laser_safety.hpp).
struct LaserSafety {
  bool stated = false;     // the mission says something of it
  double laser_class = 0;  // position in the choices of sensor.laser_class; 0: not stated
  double hazard_distance_m = 0;
  double inhibits = 0;  // in hardware
};

// A sensor besides [sensor]. The simulated one is as the mission says, with its kind's beam; what a scenario says of dropouts, outliers,
// grazing rays and edges holds for it, too.
struct FurtherSensor {
  std::string name;
  SensorKind kind = SensorKind::kLaserCamera;
  SensorParameters parameters{};
  sim::FlashModel flash;  // kFlashLidar
  LaserSafety laser;
  std::vector<std::string> calibration_files;  // as they were written
  sim::DetectorModel detector;
  std::string node;                  // where it stands; empty: in the sensor frame
  std::optional<Pose> T_sensor_own;  // its own frame in the sensor frame, where it names a node
};

// Of laser cameras, by the number of the sensor; of several of one camera the first holds until a command says otherwise.
using Calibrations = std::map<std::uint8_t, std::vector<TriangulationCalibration>>;

// What is doubtful about the mission by itself, or about a scenario, by the number of the rule that says so.
struct Doubt {
  std::size_t rule = 0;
  std::string scenario;  // empty: the mission by itself
  Problem problem;
};

// What the simulation does: where the target is, what the component is given to start from, what is simulated otherwise than it believes,
// and what the results compare.
//
// Without ranges the target, the sensor and all else move as the mission's nodes do: one run. With ranges the target is alone before a
// sensor at rest. Its attitude at frame 0: x axis vertical in the image (+x up, -y of the sensor), z axis away from the sensor, then
// tilted by `tilt_rad` about the sensor's x (the -x end towards the sensor), then by `boresight_rad` about the boresight. From there it
// turns at `spin_radps` and drifts at `drift_mps`; or it stands still in each scan, and is turned by `step_rad` about its own x axis from
// frame to frame. Where the motion is `drawn`, each run has an attitude, and axes of spin and drift, of its own, with magnitudes as given.
//
// The track starts from the true pose of one frame before, at rest, and does so again when it is lost; without `prior` the component seeks
// the bearing instead. `autonomous`: it is told once to seek the bearing, is offered poses by a simulated navigation system, and nobody
// else helps. Between the two times of `eclipse_s` nothing returns.
struct Scenario {
  std::vector<double> ranges_m;  // of center_m along the boresight: one run each, or, with times_s, one run; of nodes: as they move
  double autonomous = 0;         // 1: see above
  double variants = 0;           // 1: flown as the paper compares it: without noise, from hits alone, with aimed rays, and side-on
  double frames = 0, step_rad = 0, tilt_rad = 0, boresight_rad = 0;
  double roll_rad = 0;                      // of the target about its own x axis, before all else
  double drawn = 0;                         // 1: at random, by the run's seed
  double paper_table = 0;                   // 1: the scenario is the paper's own, whose table stands beside its results
  std::vector<double> offset_m{0, 0};       // x, y of the target's centre in the sensor frame
  std::vector<double> center_m{0, 0, 0};    // that point in the target's frame: ranges are its own, and the target turns about it
  std::vector<double> spin_radps{0, 0, 0};  // x, y, z in the target's axes
  std::vector<double> drift_mps{0, 0, 0};   // x, y, z in the sensor's axes
  std::vector<double> times_s;              // since frame 0, at which the target is at its ranges, at rest; none: it stays at each
  std::vector<double> eclipse_s;            // begin and end; none where these are the same
  double navigation_from_s = 0, navigation_period_s = 0, navigation_sigma_m = 0, navigation_sigma_rad = 0;
  double prior = 1;                    // 0: no pose to start from is given; the component is commanded to seek the bearing
  std::vector<double> prior_turn_rad;  // rotation vector in the target's axes by which the pose to start from is wrong
  std::vector<double> prior_shift_m;   // and by which its position is, in sensor axes
  // How the simulated target differs from the model that the component has, in this order; in target axes.
  double model_scale = 1;                  // of all lengths, about the target's origin
  double model_vertex_sigma_m = 0;         // each coordinate of each vertex, at random
  std::vector<double> model_turned_box_m;  // low x, y, z, high x, y, z: triangles whose centres lie in it are turned ...
  std::vector<double> model_turn_rad;      // ... about its middle by this rotation vector
  std::vector<double>
      model_gone_box_m;  // triangles whose centres, as the model has them, lie in it are not there; boxes without size: none
  // The simulated sensor, as against the noise that the estimator assumes ([sensor]), from which unwritten values are taken.
  double noise = 1;         // 0: perfect ranges and angles
  double noise_factor = 1;  // of the range noise
  double sigma0_m = 0, sigma_k_per_m = 0, angle_noise_rad = 0, dropout_probability = 0;
  double common_sigma_m = 0, common_sigma_k_per_m = 0, common_sigma_rad = 0, common_memory_s = 0;
  double dropout_incidence_rad = 0;  // rays that graze the surface more than this do not return
  double outlier_probability = 0, edge_mixing_m = 0, beam_divergence_rad = 0;
  double seed = 0;
  sim::DetectorModel detector;  // of [sensor]
  double fault_script = -1;     // of a campaign's case: which of its camera_faults; -1: none

  // The first range of each run.
  std::vector<double> runs_m() const { return has_profile() ? std::vector<double>{ranges_m.front()} : ranges_m; }
  bool has_profile() const { return !times_s.empty(); }                   // one run that goes through several ranges
  bool has_timeline() const { return has_profile() || autonomous != 0; }  // one run that is shown along its time
  bool seeks_bearing() const { return prior == 0 || autonomous != 0; }
  std::map<std::string, double> overrides;  // key of a parameter row -> value in the row's TOML unit
  std::shared_ptr<const SceneRun> scene;    // of the mission's nodes; null: it says ranges
};

struct MissionSource {
  std::filesystem::path file;
  std::vector<std::filesystem::path> named_files;  // which it names, found: models, meshes, calibrations, tables, scripts
  std::uint32_t id = 0, version = 0;
  std::string name;
  TargetSource target;
  std::vector<PartSource> parts;  // in the order of their names, which is that of their numbers
  SensorKind sensor = SensorKind::kLaserCamera;
  sim::FlashModel flash;  // kFlashLidar
  LaserSafety laser;
  std::vector<std::string> calibration_files;  // as a further sensor's
  std::vector<FurtherSensor> further_sensors;  // in the order of their names: numbers 1, 2, ... ; [sensor] is number 0
  Calibrations calibrations;
  MissionParameters parameters{};
  SceneSource scene;
  sim::DetectorModel detector;  // of [sensor]
  std::vector<MaterialSource> materials;
  std::vector<sim::LaserReflection> target_laser;  // of each triangle of the target, filled by load_scene; none: no sensor sees light
  StereoSource stereo;
  std::map<std::string, Scenario> scenarios;
  std::map<std::string, CampaignSource> campaigns;
  std::map<std::string, Origin> origins;  // by dotted key, all rows of parameter_rows() and of the ground sections
  std::vector<std::string> warnings;      // of what was read
  std::vector<Doubt> doubts;              // of values (warnings_for)
  std::vector<std::string> settings;      // KEY=VALUE of the command line, which hold in place of the file's
};

// What is wrong with a key of the mission, at the place where it is written.
Problem problem_at(const MissionSource& source, const std::string& key, const std::string& value, const std::string& expected);

// Reads and checks everything except the geometry of the target (load_target) and what has to fit it (check_target). Each of `settings`,
// KEY=VALUE, is checked as if the file said it, and holds in its place. Throws MissionError with all problems.
MissionSource load_mission(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
// The same of a text, as if `file` held it: what it names is looked for from there.
MissionSource load_mission_text(const std::string& text, const std::filesystem::path& file);

// A setting that changes nothing in this scenario (empty: none): it is another scenario's, or this one overrides it. Throws MissionError
// that names the key to set.
void check_settings(const MissionSource& source, const std::string& scenario);

// The target's surface in metres, in the target frame. Throws MissionError (missing, corrupt, empty, not finite, of absurd size).
// `warnings`, where given, get what the file holds and is no surface.
Mesh load_target(const MissionSource& source, std::vector<std::string>* warnings = nullptr);

// Whether the mission's values fit the target's size. Throws MissionError where they contradict it; adds what is doubtful to the warnings.
void check_target(MissionSource& source, const Mesh& target);

// What is doubtful: of the mission by itself and the scenario, or (no name) of all, each doubt once with the scenarios that have it.
std::vector<std::string> warnings_for(const MissionSource& source, const std::string& scenario);

// The surface of one of its parts in metres, in the part's frame; `target` is load_target's. Throws MissionError (as load_target; a box in
// which nothing lies); `warnings` as there.
Mesh load_part(const MissionSource& source, const PartSource& part, const Mesh& target, std::vector<std::string>* warnings = nullptr);

// The flight parameters that hold in a scenario: the mission's, with the scenario's overrides. An empty name: the mission's own.
// Throws MissionError where there is no such scenario.
MissionParameters parameters_for(const MissionSource& source, const std::string& scenario);
MissionParameters parameters_for(const MissionSource& source, const Scenario& scenario);

// The scenario's definition. Throws MissionError naming those that exist.
const Scenario& scenario_of(const MissionSource& source, const std::string& name);

}  // namespace lasso::mdat
