#include "mdat/recording/run_recorders.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace lasso::mdat {

std::vector<std::filesystem::path> recording_files(const std::filesystem::path& file, const std::vector<double>& ranges_m) {
  if (ranges_m.size() == 1) return {file};
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const auto before = std::count(ranges_m.begin(), ranges_m.begin() + static_cast<std::ptrdiff_t>(i), ranges_m[i]);
    char range[48];
    (void)std::snprintf(range, sizeof range, before > 0 ? "-%gm_%td" : "-%gm", ranges_m[i], before + 1);
    std::filesystem::path place = file;
    files.push_back(place.replace_filename(file.stem().string() + range + file.extension().string()));
  }
  return files;
}

RunRecorders::RunRecorders(const std::vector<std::filesystem::path>& files, const CompiledMission& mission, const RecordingHead& head,
                           RecordingContent content) {
  for (std::size_t range = 0; range < files.size(); ++range) {
    RecordingHead of_range = head;
    of_range.about["range"] = std::to_string(range);
    scans_.push_back(std::make_shared<sim::SensorRecording>());
    recorders_.push_back(std::make_unique<BackgroundRecorder>(files[range], mission, of_range, scans_.back(), content));
  }
}

std::vector<SimulationOptions::CaseRecorder> RunRecorders::cases() const {
  std::vector<SimulationOptions::CaseRecorder> cases;
  for (std::size_t i = 0; i < recorders_.size(); ++i) cases.push_back({scans_[i], recorders_[i].get()});
  return cases;
}

void RunRecorders::close(const std::vector<std::uint8_t>& image) {
  for (const auto& recorder : recorders_) recorder->close(image);
}

}  // namespace lasso::mdat
