// Whether a PLY file is as long as its header says. Inside of missiondb.
#pragma once

#include <cstddef>
#include <string_view>

namespace lasso::mdat {

// The number of faces. Throws MeshError: not PLY, no face, or fewer elements than announced.
std::size_t precheck_ply(std::string_view bytes);

}  // namespace lasso::mdat
