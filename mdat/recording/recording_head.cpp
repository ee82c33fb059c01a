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

// The mission's files, and which of them it is.
void add_mission(const MissionSource& mission, RecordingHead& head) {
  const std::vector<fs::path> files = files_of(mission);
  const fs::path folder = shared_folder(files);
  const auto name_of = [&](const fs::path& file) { return kMissionFolder + file.lexically_relative(folder).generic_string(); };
  for (const fs::path& file : files) head.files[name_of(file)] = file_content(file);
  head.about["mission"] = name_of(fs::absolute(mission.file).lexically_normal());
}

}  // namespace

RecordingHead recording_head(const CompiledMission& mission, const SimulationOptions& options, const std::vector<std::string>& settings,
                             mcap::Text about) {
  RecordingHead head;
  head.about = std::move(about);
  add_mission(mission.source, head);
  const Scenario& scenario = mission.source.scenarios.at(options.scenario);
  head.about["frames"] = std::to_string(options.frames.value_or(static_cast<std::uint32_t>(scenario.frames)));
  head.about["scenario"] = options.scenario;
  head.about["seed"] = std::to_string(options.seed.value_or(static_cast<std::uint64_t>(scenario.seed)));
  head.about["settings"] = joined_settings(settings);
  return head;
}

RecordingHead link_recording_head(const CompiledMission* mission, const std::string& address, mcap::Text about) {
  RecordingHead head;
  head.about = std::move(about);
  head.about[kLinkAddress] = address;
  head.about["sensor"] = "telemetry of a link";
  if (mission == nullptr) return head;
  add_mission(mission->source, head);
  const std::vector<std::uint8_t> image = image_bytes(*mission, mission->source.parameters);
  head.files[kImageAttachment] = std::string(image.begin(), image.end());
  return head;
}

std::map<std::string, std::string> store_files(const std::string& folder) {
  std::map<std::string, std::string> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (!entry.is_regular_file()) continue;
    std::string content = file_content(entry.path());
    content.resize(content.find_last_not_of('\0') + 1);
    files[kStoreFolder + entry.path().filename().string()] = std::move(content);
  }
  return files;
}

}  // namespace lasso::mdat
