// A commented mission for any target, ready to compile.
#pragma once

#include <filesystem>
#include <string>

namespace lasso::mdat {

// Writes a mission for the mesh (or the parametric model, .toml) at `model`, whose lengths times `scale` are metres. Values that depend on
// the target's size follow from its extents: the initial range at which it fits the field of view, gates, bands and margins. `out` is
// written by a rename at the end, or not at all. Throws MissionError.
void write_new_mission(const std::filesystem::path& model, double scale, const std::filesystem::path& out);

// The text alone; `model_path` is what the mission says about the model's place.
std::string new_mission_text(const std::filesystem::path& model, double scale, const std::string& model_path);

}  // namespace lasso::mdat
