#include "mdat/serve/flight.hpp"

#include <exception>
#include <memory>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/recording/frame_recorder.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat::serve {
namespace {

class Stopped final : public std::exception {};  // ends the run, and is no error

// Records, and waits at each boundary for the watcher's pace. What came before is in the file by then.
class Watched final : public RunListener {
 public:
  Watched(FrameRecorder& recorder, Pacing& pacing, const FlightTold& told) : recorder_(recorder), pacing_(pacing), told_(told) {}

  void on_packets(TimeUs boundary_us, ConstBytes packets) override {
    told_.written(recorder_.flush());
    if (!pacing_.pass(boundary_us)) throw Stopped{};
    told_.packets(boundary_us, packets);
    recorder_.on_packets(boundary_us, packets);
  }
  void on_frame(const FlownFrame& frame) override { recorder_.on_frame(frame); }

 private:
  FrameRecorder& recorder_;
  Pacing& pacing_;
  const FlightTold& told_;
};

SimulationOptions options_of(const FlightOrder& order) {
  SimulationOptions options;
  options.scenario = order.scenario;
  options.seed = order.seed;
  options.plain = true;
  return options;
}

// The image that will fly stands first, so that who reads the file meanwhile knows limits and field of view.
RecordingHead head_of(const FlightOrder& order, const std::string& commit, const CompiledMission& mission) {
  const Scenario& scenario = scenario_of(mission.source, order.scenario);
  const CaseSetup setup = plain_case(mission.source, scenario, order.seed.value_or(static_cast<std::uint64_t>(scenario.seed)),
                                     static_cast<std::uint32_t>(scenario.frames));
  RecordingHead head = recording_head(mission, options_of(order), {}, {{"sensor", "simulated"}, {"commit", commit}});
  const std::vector<std::uint8_t> image = image_bytes(mission, setup.parameters);
  head.files[kImageAttachment] = std::string(image.begin(), image.end());
  return head;
}

CompiledMission compiled(const FlightOrder& order) {
  MissionInput input = load_mission_input(order.mission, {}, order.scenario);
  check_simulation(input.source, options_of(order), false);
  const std::size_t runs = scenario_of(input.source, order.scenario).runs_m().size();
  if (runs > 1)
    throw InputError("the scenario " + order.scenario + " has " + std::to_string(runs) +
                     " runs, and one is shown at a time: choose a scenario of one range");
  return compile_mission(std::move(input), ModelCache::of_user());
}

bool flown_to_its_end(const CompiledMission& mission, const SimulationOptions& options) {
  try {
    (void)simulate(mission, options);
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

}  // namespace

void fly(const FlightOrder& order, const std::string& commit, Pacing& pacing, const FlightTold& told) {
  const CompiledMission mission = compiled(order);
  SimulationOptions options = options_of(order);
  const auto scans = std::make_shared<sim::SensorRecording>();
  FrameRecorder recorder(order.file, mission, head_of(order, commit, mission), scans);
  Watched watched(recorder, pacing, told);
  options.recorders = {{scans, &watched}};
  told.begun(static_cast<std::uint32_t>(scenario_of(mission.source, order.scenario).frames));
  (void)flown_to_its_end(mission, options);  // of one that was stopped the recording is whole as well
  recorder.close({});
}

std::string flight_command(const FlightOrder& order) {
  std::string text = "mdat run " + shell_word(order.mission.string()) + " --scenario " + shell_word(order.scenario);
  if (order.seed) text += " --seed " + std::to_string(*order.seed);
  return text + " --record " + shell_word(order.file.string()) + " --live --pace " + format("%g", order.pace);
}

}  // namespace lasso::mdat::serve
