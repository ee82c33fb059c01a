#include "mdat/campaign/kept_mission.hpp"

#include <algorithm>
#include <stdexcept>

#include "mdat/common/errors.hpp"
#include "mdat/missiondb/mission_files.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kFolder[] = "mission", kUnfinished[] = "mission.part";

fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  const auto differ = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  for (auto part = a.begin(); part != differ; ++part) common /= *part;
  return common;
}

fs::path common_folder(const std::vector<fs::path>& files) {
  fs::path common = files.front().parent_path();
  for (const fs::path& file : files) common = common_folder(common, file.parent_path());
  return common;
}

}  // namespace

KeptMission kept_mission(const MissionSource& source) {
  const std::vector<fs::path> files = files_of(source);
  const fs::path common = common_folder(files);
  const auto name_of = [&](const fs::path& file) { return (kFolder / file.lexically_relative(common)).generic_string(); };
  KeptMission kept{name_of(fs::absolute(source.file).lexically_normal()), {}};
  for (const fs::path& file : files) kept.originals.emplace(name_of(file), file);
  return kept;
}

std::map<std::string, std::string> KeptMission::digests() const {
  std::map<std::string, std::string> digests;
  for (const auto& [name, original] : originals) {
    try {
      digests.emplace(name, sha256_of_file(original));
    } catch (const std::runtime_error& error) {
      throw InputError(original.string() + ": " + error.what());
    }
  }
  return digests;
}

void keep_mission(const KeptMission& kept, const fs::path& folder) try {
  const fs::path unfinished = folder / kUnfinished;
  fs::remove_all(unfinished);
  for (const auto& [name, original] : kept.originals) {
    const fs::path copy = unfinished / fs::path(name).lexically_relative(kFolder);
    fs::create_directories(copy.parent_path());
    fs::copy_file(original, copy);
  }
  fs::remove_all(folder / kFolder);
  fs::rename(unfinished, folder / kFolder);
} catch (const fs::filesystem_error& error) {
  throw InputError((folder / kFolder).string() + ": the mission cannot be kept there: " + error.what());
}

}  // namespace lasso::mdat
