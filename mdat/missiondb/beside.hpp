// Files that a mission names: in its folder, or in the one above. Inside of missiondb.
#pragma once

#include <filesystem>
#include <string>

namespace lasso::mdat {

// False, and `found` is in the folder above, where neither has it.
inline bool find_beside(const std::filesystem::path& mission, const std::string& written, std::filesystem::path& found) {
  const std::filesystem::path folder = std::filesystem::absolute(mission).parent_path();
  for (const auto& candidate : {folder / written, folder.parent_path() / written}) {
    found = candidate.lexically_normal();
    if (std::filesystem::is_regular_file(candidate)) return true;
  }
  return false;
}

}  // namespace lasso::mdat
