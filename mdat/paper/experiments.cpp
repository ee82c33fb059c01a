#include "mdat/paper/experiments.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <utility>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr char kSimulationMission[] = "hubble_tenth.toml";
constexpr char kSimulationScenario[] = "paper";
constexpr char kLaboratoryMission[] = "laboratory.toml";

CompiledMission compiled(const PaperOptions& options, const char* name, const std::string& scenario) {
  const std::filesystem::path file = options.missions / name;
  if (!std::filesystem::exists(file))
    throw InputError(file.string() + ": no such file; --missions DIR names the folder of the shipped missions");
  MissionInput input = load_mission_input(file, {}, scenario);
  if (scenario.empty()) check_laboratory(input.source);
  return compile_mission(std::move(input), ModelCache::of_user_if(options.cached));
}

SimulationResult simulate_with(CompiledMission& mission, const PaperOptions& options, bool noise) {
  mission.source.scenarios.at(kSimulationScenario).noise = noise ? 1 : 0;
  SimulationOptions simulation;
  simulation.scenario = kSimulationScenario;
  simulation.frames = options.frames;
  simulation.jobs = options.jobs;
  simulation.plain = true;
  return simulate(mission, simulation);
}

SimulationResult fly_simulation(const PaperOptions& options) {
  CompiledMission mission = compiled(options, kSimulationMission, kSimulationScenario);
  SimulationResult result = simulate_with(mission, options, false);
  SimulationResult noisy = simulate_with(mission, options, true);
  result.tables.front().variants.push_back(std::move(noisy.tables.front().variants.front()));
  result.seconds += noisy.seconds;
  return result;
}

LaboratoryOptions laboratory_options(const PaperOptions& options, const MissionSource& source) {
  LaboratoryOptions laboratory = options.laboratory;
  laboratory.jobs = options.jobs;
  if (options.frames && !source.scenarios.empty())
    laboratory.frames = std::min(*options.frames, static_cast<std::uint32_t>(source.scenarios.begin()->second.frames));
  return laboratory;
}

// As Linux names the processor.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "a processor that does not say its name";
}

}  // namespace

PaperResult repeat_paper(const PaperOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const CompiledMission laboratory = compiled(options, kLaboratoryMission, "");
  PaperResult result;
  result.simulation = fly_simulation(options);
  result.laboratory = fly_laboratory(laboratory, laboratory_options(options, laboratory.source));
  result.machine = processor_name();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::vector<PaperItem> paper_items() {
  const std::string unknown = "not known here";
  return {{"Table 1", "errors of the simulation without noise, 2 to 7 m, 360 frames each", "the simulation"},
          {"Table 2", "errors of the laboratory test", "the laboratory test, simulated"},
          {"Figure 4", unknown, "nothing"},
          {"Figure 5", unknown, "nothing"},
          {"Figure 9", unknown, "nothing"},
          {"Figure 11", "errors against the target's angle; its curves are not known here", "the simulation's curves alone"},
          {"Figure 12", unknown + "; of figures 11 to 14 it is known that they tell where a pose is uncertain", "nothing"},
          {"Figure 13", "errors against the range; its points are not known here", "the simulation's points alone"},
          {"Figure 14", unknown + ", as figure 12", "nothing"}};
}

}  // namespace lasso::mdat
