#include "mdat/recording/recording_head.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "mdat/common/output.hpp"
#include "mdat/missiondb/mission_files.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// The deepest folder that holds all of them.
fs::path shared_folder(const std::vector<fs::path>& files) {
  fs::path shared = files.front().parent_path();
  for (const fs::path& file : files) {
    while (std::mismatch(shared.begin(), shared.end(), file.begin(), file.end()).first != shared.end()) shared = shared.parent_path();
  }
  return shared;
}

std::string joined_settings(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : "\n") + setting;
  return text;
}

}  // namespace

RecordingHead recording_head(const CompiledMission& mission, const SimulationOptions& options, const std::vector<std::string>& settings,
                             mcap::Text about) {
  RecordingHead head;
  const std::vector<fs::path> files = files_of(mission.source);
  const fs::path folder = shared_folder(files);
  const auto name_of = [&](const fs::path& file) { return kMissionFolder + file.lexically_relative(folder).generic_string(); };
  for (const fs::path& file : files) head.files[name_of(file)] = file_content(file);
  const Scenario& scenario = mission.source.scenarios.at(options.scenario);
  about["frames"] = std::to_string(options.frames.value_or(static_cast<std::uint32_t>(scenario.frames)));
  about["mission"] = name_of(fs::absolute(mission.source.file).lexically_normal());
  about["scenario"] = options.scenario;
  about["seed"] = std::to_string(options.seed.value_or(static_cast<std::uint64_t>(scenario.seed)));
  about["settings"] = joined_settings(settings);
  head.about = std::move(about);
  return head;
}

}  // namespace lasso::mdat
