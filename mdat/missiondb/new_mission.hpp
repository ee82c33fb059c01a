// Beginning a mission from a mesh: it is measured, compiled for trial, and written with what was guessed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

using ModelCompiler = std::function<ModelTables(const Mesh&, const ModelOptions&, CompileReport&)>;

constexpr std::size_t kSimplifyChosen = 1;  // of NewMissionRequest::simplify: a quarter of the triangles, at most 20,000

struct NewMissionRequest {
  std::filesystem::path model, out;  // the target's file, a mesh or a parametric model; the mission to write
  std::string model_text;            // of a parametric model that is written to `model`; empty: the file is there
  std::string name;                  // of the mission; empty: that of the target's file, or of the mission's where the target is made
  std::optional<SensorKind> sensor;  // otherwise guessed from the target's size
  double scale = 1;                  // the file's lengths times this are metres
  std::size_t simplify = 0;          // triangles of the coarser mesh that is written beside the mission; 0: none
  bool replace = false;              // files that are there
  ModelCompiler compile = [](const Mesh& mesh, const ModelOptions& options, CompileReport& report) {
    return compile_model(mesh, options, report);
  };
};

// Returns what was guessed, a line each. Throws MissionError, and leaves nothing behind, where the model cannot be read or compiled with
// any cell, or a file cannot be written.
std::vector<std::string> write_new_mission(const NewMissionRequest& request);

}  // namespace lasso::mdat
