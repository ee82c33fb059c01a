// Puts the tables of a mission into the bytes that the flight component loads.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/mission/parameters.hpp"
#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

// The whole image, big-endian, with directory, checksums and trailer (image_format.hpp). Throws CompileError over kMaxImageBytes.
std::vector<std::uint8_t> write_image(std::uint32_t mission_id, std::uint32_t mission_version, const MissionParameters& parameters,
                                      const ModelTables& tables);

}  // namespace lasso::mdat
