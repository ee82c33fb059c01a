// The recordings of a run: a file for each range of its scenario.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "mdat/recording/background_recorder.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// `file` itself for one range; else "run-4m.mcap", "run-4m_2.mcap", and so on.
std::vector<std::filesystem::path> recording_files(const std::filesystem::path& file, const std::vector<double>& ranges_m);

class RunRecorders {
 public:
  // `mission` outlives it; `head` is that of the run. Throws as BackgroundRecorder.
  RunRecorders(const std::vector<std::filesystem::path>& files, const CompiledMission& mission, const RecordingHead& head,
               RecordingContent content);

  std::vector<SimulationOptions::CaseRecorder> cases() const;
  // Ends the files, with the flight image that flew.
  void close(const std::vector<std::uint8_t>& image);

 private:
  std::vector<std::shared_ptr<sim::SensorRecording>> scans_;
  std::vector<std::unique_ptr<BackgroundRecorder>> recorders_;
};

}  // namespace lasso::mdat
