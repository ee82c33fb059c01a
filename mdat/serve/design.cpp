#include "mdat/serve/design.hpp"

#include <algorithm>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/missiondb/mission_edit.hpp"
#include "mdat/missiondb/mission_files.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/serve/http.hpp"
#include "mdat/serve/new_folder.hpp"
#include "mdat/source/mission_error.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;

constexpr char kMend[] = "mend what it says; mdat mission check says the same";

// The folder that holds all of them.
fs::path folder_of_all(const std::vector<fs::path>& files) {
  fs::path common = files.front().parent_path();
  for (const fs::path& file : files) {
    fs::path both;
    const fs::path other = file.parent_path();
    const auto differ = std::mismatch(common.begin(), common.end(), other.begin(), other.end()).first;
    for (auto part = common.begin(); part != differ; ++part) both /= *part;
    common = both;
  }
  return common;
}

std::vector<fs::path> files_of_mission(const LiveMission& mission) {
  try {
    MissionSource source = load_mission(mission.file);
    static_cast<void>(load_target(source));
    return files_of(source);
  } catch (const std::runtime_error& error) {
    throw Refusal{422, error.what(), kMend};
  }
}

// Each as far from the others as it was, so that what they say of each other holds.
void copy_files(const std::vector<fs::path>& files, const fs::path& from, const fs::path& to) {
  try {
    for (const fs::path& file : files) {
      const fs::path copy = to / file.lexically_relative(from);
      fs::create_directories(copy.parent_path());
      fs::copy_file(file, copy);
    }
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(to, ignored);
    throw Refusal{409, std::string("the mission cannot be copied: ") + error.what(), "see whether mdat serve may write into its folder"};
  }
}

}  // namespace

MissionText Design::open(const LiveMission& mission) const {
  try {
    const std::string text = file_content(mission.file);
    return {text, sha256_of(text)};
  } catch (const InputError& error) {
    throw Refusal{409, error.what(), "see whether the file is still there"};
  }
}

std::string Design::set(const LiveMission& mission, const std::string& text, const std::vector<std::string>& settings) {
  try {
    return edited(text, settings, mission.file);
  } catch (const MissionError& error) {
    throw Refusal{422, error.what(), "edit the text instead"};
  }
}

std::string Design::save(const LiveMission& mission, const std::string& text, const std::string& digest) {
  if (mission.shipped) throw Refusal{403, "a shipped mission is not changed", "make a copy, and change that"};
  const std::lock_guard lock(writing_);
  if (open(mission).digest != digest)
    throw Refusal{409, "the file was changed on disk meanwhile", "copy what you want to keep, and load the mission again"};
  try {
    static_cast<void>(load_mission_text(text, mission.file));
    write_file(mission.file, text);
  } catch (const MissionError& error) {
    throw Refusal{422, error.what(), kMend};
  } catch (const InputError& error) {
    throw Refusal{409, error.what(), "see whether mdat serve may write there"};
  }
  return sha256_of(text);
}

std::string Design::copy(const LiveMission& mission, const std::string& name) {
  const fs::path to = new_folder_path(folder_, name);
  const std::lock_guard lock(writing_);
  if (fs::exists(fs::symlink_status(to))) throw Refusal{409, name + " is there already", "take another name"};
  const std::vector<fs::path> files = files_of_mission(mission);
  const fs::path from = folder_of_all(files);
  copy_files(files, from, to);
  const fs::path own = fs::absolute(mission.file).lexically_normal();
  return (fs::path(name) / own.lexically_relative(from)).generic_string();
}

}  // namespace lasso::mdat::serve
