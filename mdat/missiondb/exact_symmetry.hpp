// The proper rotations that bring a mesh exactly on itself: poses that no scan can tell apart.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct ExactSymmetry {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // which each rotation leaves where it is
  std::vector<Eigen::Quaterniond> turns;  // the group, the identity first; of a round body one turn for each way its axis may point
  std::optional<Eigen::Vector3d> axis;    // of a body that any turn about it brings on itself: unit
  bool sphere = false;                    // any rotation does
  bool none() const { return turns.size() == 1 && !axis && !sphere; }
};

// A mesh of revolution counts as round where it has at least so many sides.
constexpr std::size_t kRoundTurns = 16;

// A rotation is in the group where it brings each vertex to within `tolerance` (a share of the largest extent) of a vertex. Two vertices,
// not in line with the area's centroid, decide a rotation; all images of the two rarest are tried. Bodies that have the same surface by
// other vertices are not found: a model whose parts repeat has the vertices repeated.
ExactSymmetry exact_symmetry(const Mesh& mesh, double tolerance = 1e-5);

// For a person: "none", "4 turns, the least by 90 deg about (1, 0, 0)", "any turn about (1, 0, 0), and end for end".
std::string symmetry_text(const ExactSymmetry& symmetry);

}  // namespace lasso::mdat
