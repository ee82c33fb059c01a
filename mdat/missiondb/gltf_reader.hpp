// Meshes of glTF 2.0. Inside of missiondb.
#pragma once

#include <filesystem>
#include <string_view>

#include "mdat/missiondb/file_mesh.hpp"

namespace lasso::mdat {

// The triangles of the default scene, where its nodes place them. Throws MeshError as the other readers do.
FileMesh read_gltf(const std::filesystem::path& folder, std::string_view bytes);

}  // namespace lasso::mdat
