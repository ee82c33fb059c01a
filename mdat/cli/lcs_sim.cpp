#include <atomic>
#include <cstdio>
#include <memory>
#include <utility>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/missiondb/camera_faults.hpp"
#include "mdat/run/camera.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {
namespace {

struct LcsSimArguments {
  std::string mission, listen = "tcp://127.0.0.1:0", device = "laser-camera", camera_faults, optics;
  bool remote = false, cached = true;
  SimulationOptions simulation;
};

// As --device names it, which the command line has checked.
lcs::Device device_of(const std::string& name) {
  if (name == "lidar") return lcs::Device::kLidar;
  return name == "tridar" ? lcs::Device::kTridar : lcs::Device::kLaserCamera;
}

void say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void serve(LcsSimArguments options) {
  posix::LineServer server;
  const std::string wrong = server.listen(options.listen, options.remote);
  if (!wrong.empty()) throw InputError("--listen: " + wrong);
  MissionInput input = load_mission_input(options.mission);
  (void)scenario_of(input.source, options.simulation.scenario);
  if (!options.camera_faults.empty()) options.simulation.camera_faults = load_camera_faults(options.camera_faults);
  if (!options.optics.empty()) options.simulation.camera_optics = load_calibration(options.optics);
  options.simulation.wire = device_of(options.device);
  const CompiledMission mission = compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
  const Scenario& scenario = scenario_of(mission.source, options.simulation.scenario);
  const std::uint64_t seed = options.simulation.seed.value_or(static_cast<std::uint64_t>(scenario.seed));
  const std::unique_ptr<sim::RayCaster> target = simulated_target(mission.mesh, scenario, seed, mission.source.target_laser);
  const CaseSetup setup = camera_case(mission, options.simulation, *target);
  const std::atomic<bool>& ending = interruption();
  say("the camera listens on " + server.address());
  serve_camera(setup, server, ending, say);
}

}  // namespace

void add_lcs_sim_command(CLI::App& app) {
  const auto options = std::make_shared<LcsSimArguments>();
  options->simulation.scenario = "spin";
  CLI::App* command = app.add_subcommand(
      "lcs-sim", "run the simulated laser camera, LIDAR or TriDAR alone, in real time, for whoever speaks its protocol (docs/icd/lcs.md)");
  command->add_option("MISSION", options->mission, "mission file")->required();
  command->add_option("--listen", options->listen, "pty, tcp://127.0.0.1:PORT (0: any that is free) or unix:PATH")->capture_default_str();
  command->add_option("--device", options->device, "what to be: laser-camera, lidar or tridar")
      ->capture_default_str()
      ->check(CLI::IsMember({"laser-camera", "lidar", "tridar"}));
  command->add_flag("--remote", options->remote, "others than this machine may connect");
  command->add_option("--scenario", options->simulation.scenario, "scenario of the mission: what moves in front of the camera")
      ->capture_default_str();
  command->add_option("--seed", options->simulation.seed, "start of the random numbers (the scenario's)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4294967295}));
  command->add_option("--camera-optics", options->optics, "what its optics are (a calibration file)");
  add_no_cache(*command, options->cached);
  command->add_option("--camera-faults", options->camera_faults, "script of what goes wrong (docs/user-guide.md)");
  command->callback([options] { serve(*options); });
}

}  // namespace lasso::mdat
