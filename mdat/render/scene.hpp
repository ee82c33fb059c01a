// What a picture of a mission shows: its target at one time of a scenario, before one of its sensors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/render/render.hpp"
#include "mdat/render/views.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

struct SceneRequest {
  std::string scenario;                // empty: "paper" where there is one, otherwise the first by name
  std::optional<double> range_m;       // one of the scenario's; none: its first
  double time_s = 0;                   // since frame 0
  std::optional<std::uint64_t> seed;   // otherwise the scenario's
  std::string camera;                  // the name of a sensor, or of a node with a camera; empty: the first sensor whose turn it is there
  std::vector<std::string> materials;  // PART=PRESET, where PART may end with *
};

// The scenario that a request means. Throws MissionError (none of the name) or InputError (a mission without any).
std::string scenario_name(const MissionSource& source, const std::string& asked);

struct Scene {
  std::string scenario, camera;
  std::uint64_t seed = 0;          // that it was drawn by
  CaseSetup setup;                 // as mdat run flies it; image and target are not set
  std::vector<std::string> parts;  // names by number
  std::vector<Material> materials;
  std::unique_ptr<ModelSurface> surface;  // of the simulated target, which may differ from the model, and of all else in its scene
  std::shared_ptr<const SceneRun> view;   // the scene before a camera that stands elsewhere than in the sensor frame; none: it does not
  Pose T_sensor_target;                   // the true one; with a view in the camera's frame, as lights and lamps are
  Pose T_camera_sensor;                   // with a view; else it is the same frame
  std::optional<Lights> orbit_lights;     // of a scene in an orbit
  std::vector<Lamp> lamps;                // at its nodes
  double fov_half_x_rad = 0, fov_half_y_rad = 0;
};

// Throws InputError or MissionError: no such scenario, range, sensor, part or preset.
Scene make_scene(const MissionInput& mission, const SceneRequest& request);

// The same of a case as it is flown (scenario, seed and range are its own), before its sensor of that name, at a time since frame 0.
// `seed`: of what the simulated target differs in.
Scene scene_of_case(const MissionInput& mission, const CaseSetup& setup, std::uint64_t seed, const std::string& camera, TimeUs t_us);

// Everything where it is at a time since frame 0.
void move_scene(const MissionInput& mission, TimeUs t_us, Scene& scene);

// Of where no light is given: the sun from over the right shoulder, the Earth below.
Lights usual_lights();

// What the rays of a kept scan of the scene's case found, as its camera sees them: from aside, returns where they are, and no other rays.
std::vector<ScanMark> scan_marks(const CompiledMission& mission, const Scene& scene, const KeptScan& scan);

// Throws InputError where the scenario's frames are over by then.
void check_scan_time(const Scene& scene, double time_s);

// The scan of the frame that `time_s` lies in, as mdat run flies it from frame 0 on, and what its rays found: residuals are those to the
// component's model at the true pose of each sample's own time. The scene is moved to the scan's time. `make_stereo`: as CaseSetup's.
// Throws as run_case and check_scan_time, and InputError where the frame has no scan.
std::vector<ScanMark> flown_scan(const CompiledMission& mission, double time_s, Scene& scene, const MakeStereo& make_stereo = {});

}  // namespace lasso::mdat
