#include "mdat/serve/first_run.hpp"

#include <system_error>

#include "mdat/common/text.hpp"
#include "mdat/recording/frame_recorder.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;

// Passes all on, and counts.
class Counting final : public RunListener {
 public:
  Counting(RunListener& next, double frames, std::function<void(double)> tell) : next_(next), frames_(frames), tell_(std::move(tell)) {}
  void on_packets(TimeUs boundary_us, ConstBytes packets) override { next_.on_packets(boundary_us, packets); }
  void on_frame(const FlownFrame& frame) override {
    next_.on_frame(frame);
    ++flown_;
    tell_(std::min(1.0, flown_ / frames_));
  }

 private:
  RunListener& next_;
  double frames_, flown_ = 0;
  std::function<void(double)> tell_;
};

// As mdat run has it: the component's parameters of this scenario.
void fly(const fs::path& mission_file, const fs::path& file, const std::string& commit, const std::function<void(double)>& tell) {
  SimulationOptions options;
  options.scenario = kFirstScenario;
  options.plain = true;
  const auto scans = std::make_shared<sim::SensorRecording>();
  MissionInput input = load_mission_input(mission_file, {}, options.scenario);
  check_simulation(input.source, options, false);
  const CompiledMission mission = compile_mission(std::move(input));
  const RecordingHead head = recording_head(mission, options, {}, {{"sensor", "simulated"}, {"commit", commit}});
  FrameRecorder recorder(file, mission, head, scans);
  Counting counting(recorder, mission.source.scenarios.at(options.scenario).frames, tell);
  options.recorders = {{scans, &counting}};
  const SimulationResult result = simulate(mission, options);
  recorder.close(image_bytes(mission, result.tables[0].variants[0].parameters));
}

}  // namespace

std::optional<fs::path> first_mission() {
  const fs::path name = fs::path("missions") / (std::string(kFirstMission) + ".toml");
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {fs::path("cfg"), program / "../share/3dlasso", program / "../../../cfg"}) {
    if (fs::is_regular_file(folder / name, error)) return (folder / name).lexically_normal();
  }
  return std::nullopt;
}

std::string first_command(const fs::path& mission, const fs::path& folder) {
  return "mdat run " + shell_word(mission.string()) + " --scenario " + kFirstScenario + " --record " +
         shell_word((folder / kFirstName).string());
}

void record_first(const fs::path& mission, const fs::path& folder, const std::string& commit, const std::function<void(double)>& tell) {
  const fs::path part = folder / (std::string(".") + kFirstName + ".part");
  try {
    fly(mission, part, commit, tell);
    fs::rename(part, folder / kFirstName);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

}  // namespace lasso::mdat::serve
