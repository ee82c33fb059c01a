// What is guessed of a new target, in words: a line each. Inside of missiondb.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_writer.hpp"
#include "mdat/missiondb/simplify.hpp"
#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

struct Known {
  const NewMission& mission;
  const SurfaceFacts& surface;               // of the mesh as it was given
  const std::optional<Simplified>& coarser;  // none: as it was given
  std::vector<double> widths_m;              // of its parts
  const ModelTables& tables;                 // of the compiled model
  const CompileReport& report;
};

// A measured surface is as rough as its triangles, a drawn one as good as the preset says for its size; a coarser mesh adds its error.
double guessed_surface_sigma_m(const MeshSize& size, const SurfaceFacts& surface, const std::optional<Simplified>& coarser);

std::vector<std::string> guesses(const Known& known);

}  // namespace lasso::mdat
