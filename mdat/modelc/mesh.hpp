// A triangle mesh as every ground tool hands it around.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace lasso::mdat {

// Vertices in metres in the target's frame; triangles index them, counter-clockwise seen from outside where the source knows.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace lasso::mdat
