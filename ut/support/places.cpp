#include "ut/support/places.hpp"

#include <fstream>
#include <stdexcept>
#include <string>

namespace lasso::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "source_folder.txt";

fs::path find_build_folder() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path folder = program.parent_path(); folder != folder.root_path(); folder = folder.parent_path()) {
    if (fs::exists(folder / kMark)) return folder;
  }
  throw std::runtime_error("no folder above " + program.string() + " has a file " + kMark + ": run the program where it was built");
}

fs::path read_source_folder() {
  std::string line;
  std::getline(std::ifstream(build_folder() / kMark), line);
  return line;
}

}  // namespace

const fs::path& build_folder() {
  static const fs::path folder = find_build_folder();
  return folder;
}

const fs::path& source_folder() {
  static const fs::path folder = read_source_folder();
  return folder;
}

}  // namespace lasso::test
