// Files for the tests of mission sources: the shipped ones, and a folder of its own for each test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "mdat/modelc/mesh.hpp"
#include "mdat/source/mission_error.hpp"
#include "ut/support/places.hpp"

namespace lasso::mdat {

inline const std::filesystem::path kSourceFolder = test::source_folder();
inline const std::filesystem::path kShippedMission = kSourceFolder / "cfg/missions/hubble_tenth.toml";

// A folder of one test, of its own also where the same test runs twice at a time; removed at the end.
class Folder {
 public:
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("lasso_missiondb_") + test->test_suite_name() + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    std::string path = (std::filesystem::temp_directory_path() / (name + "_XXXXXX")).string();
    if (::mkdtemp(path.data()) == nullptr) throw std::runtime_error("no folder " + path);
    path_ = path;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// The message of the MissionError that `action` throws, or "" if it throws none.
inline std::string mission_error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const MissionError& error) {
    return error.what();
  }
  return "";
}

// Every directed edge has its opposite: a closed surface, consistently oriented.
inline bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end() || opposite->second != 1) return false;
  }
  return !edges.empty();
}

}  // namespace lasso::mdat
