// Bytes that claim to be a mission file, in a folder with the mesh that the seeds name. They are refused with one line for each problem, or
// give a mission whose values are shown and whose target is loaded.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "ft/fuzz/exact.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::fuzz {
namespace {

namespace fs = std::filesystem;

// A folder of this process, with the target's mesh.
class Place {
 public:
  Place() : folder_(fs::temp_directory_path() / ("lasso_fuzz_mission_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    write(folder_ / "target.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  ~Place() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  fs::path mission(const std::string& text) const {
    write(folder_ / "mission.toml", text);
    return folder_ / "mission.toml";
  }

 private:
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
  fs::path folder_;
};

void check(const mdat::MissionError& error) {
  const std::string text = error.what();
  expect(!error.problems().empty(), "a refusal has a problem");
  expect(std::count(text.begin(), text.end(), '\n') + 1 == static_cast<std::ptrdiff_t>(error.problems().size()),
         "each problem is one line");
}

void read(ConstBytes input) {
  static const Place place;
  const fs::path file = place.mission({reinterpret_cast<const char*>(input.data()), input.size()});
  try {
    mdat::MissionSource source = mdat::load_mission(file);
    expect(!mdat::info_text(source).empty(), "a mission's values are shown");
    const mdat::Mesh target = mdat::load_target(source, &source.warnings);
    mdat::check_target(source, target);
    expect(!mdat::check_text(source, target).empty(), "a good mission is called so");
  } catch (const mdat::MissionError& error) {
    check(error);
  }
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lasso::fuzz::read({data, size});
  return 0;
}
