#include "mdat/missiondb/mission_files.hpp"

#include <set>

#include "mdat/missiondb/gltf_file.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {

std::vector<std::filesystem::path> files_of(const MissionSource& source) {
  std::set<std::filesystem::path> files{std::filesystem::absolute(source.file).lexically_normal()};
  for (const std::filesystem::path& file : source.named_files) {
    files.insert(file);
    if (file.extension() != ".gltf") continue;
    const GltfFile mesh(file.parent_path(), read_file(file));
    for (const std::filesystem::path& buffer : mesh.files()) files.insert(buffer.lexically_normal());
  }
  return {files.begin(), files.end()};
}

}  // namespace lasso::mdat
