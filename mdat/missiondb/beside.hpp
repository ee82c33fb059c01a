// Files that a mission names: in its folder, or in the one above. Inside of missiondb.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// What is found is one of the source's named files. False, and `found` is in the folder above, where neither has it.
inline bool find_beside(MissionSource& source, const std::string& written, std::filesystem::path& found) {
  const std::filesystem::path folder = std::filesystem::absolute(source.file).parent_path();
  for (const auto& candidate : {folder / written, folder.parent_path() / written}) {
    found = candidate.lexically_normal();
    std::error_code unnameable;  // such as a name that is too long
    if (!std::filesystem::is_regular_file(candidate, unnameable)) continue;
    source.named_files.push_back(found);
    return true;
  }
  return false;
}

}  // namespace lasso::mdat
