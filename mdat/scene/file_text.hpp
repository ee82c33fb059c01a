// Texts of files, and errors of the readers of scans as problems. Inside of scene.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "mdat/scene/problems.hpp"

namespace lasso::mdat::scene {

// The file's bytes. Throws MissionError.
std::string text_of_file(const std::filesystem::path& file);

// "file:line:column: text", or without column, or without both.
void add_error(const std::exception& error, const std::string& file, Problems& problems);

}  // namespace lasso::mdat::scene
