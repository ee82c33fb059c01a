// Folders that tests and rigs need while they run. They are found from where the program lies, not compiled in: a compiler cache then finds
// the same program in every clone.
#pragma once

#include <filesystem>

namespace lasso::test {

// The build folder: the nearest folder above this program that has a file source_folder.txt. Throws std::runtime_error if none has.
const std::filesystem::path& build_folder();

// The top of the repository, as CMake wrote it into source_folder.txt.
const std::filesystem::path& source_folder();

}  // namespace lasso::test
