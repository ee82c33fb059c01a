// Which part of the target each of its triangles belongs to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

struct TargetParts {
  std::vector<std::string> names;          // each once
  std::vector<std::uint32_t> of_triangle;  // index into names, for each triangle of the mesh
};

// `mesh` is load_target's. Of a parametric model a part is a solid of its file; several of one name are one part. Of a mesh a part is the
// first [part.NAME] of the mission with box_m whose box has the triangle's centre in it; the rest is "target". Throws as build_model.
TargetParts target_parts(const MissionSource& source, const Mesh& mesh);

// Whether a part is meant: by its name, or by the beginning of it with * at the end.
bool matches_part(const std::string& part, const std::string& pattern);

// The number of a name, which joins the others where it is new.
std::uint32_t number_of_name(std::vector<std::string>& names, const std::string& name);

}  // namespace lasso::mdat
