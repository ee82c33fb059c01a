// Parametric models: a TOML file of primitives and parameters (cfg/models/README.md says how to write one), built into a mesh.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct ModelParameter {
  std::string name, unit, meaning;
  double preset = 0, minimum = 0, maximum = 0;  // in `unit`
};

// In the file's order of names. Throws MissionError with the places in the model's file.
std::vector<ModelParameter> model_parameters(const std::filesystem::path& file);

// A [[part]] of the model with its copies: the triangles of its surface follow those of the part before.
struct ModelSolid {
  std::string name;
  std::size_t triangles = 0;
};

// The union of the parts as closed, outward-oriented surfaces that may run through each other; metres after the model's own scale.
// `values`: parameters that differ from their presets, in the units that the model states. `solids`, where given, gets the parts in the
// order of the mesh's triangles. Throws MissionError.
Mesh build_model(const std::filesystem::path& file, const std::map<std::string, double>& values, std::vector<ModelSolid>* solids = nullptr);
// The same of the text of such a file.
Mesh build_model_text(const std::string& text, const std::map<std::string, double>& values);

}  // namespace lasso::mdat
