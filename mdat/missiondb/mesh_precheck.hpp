// Truncation that the mesh library would accept in silence. Inside of missiondb.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace lasso::mdat {

// The number of faces that the file claims to hold, as far as its format says so (otherwise 1). Throws MeshError: unknown kind of file,
// empty, or shorter than its own header says.
std::size_t precheck_mesh_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace lasso::mdat
