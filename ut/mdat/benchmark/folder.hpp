// For tests of benchmark sets: a folder that passes, a small set made once, and what an error says.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "mdat/benchmark/benchmark_set.hpp"
#include "mdat/common/output.hpp"

namespace lasso::test {

class PassingFolder {
 public:
  PassingFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "benchmark-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "no folder for the test";
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// Body 52 has few triangles: its model compiles in a quarter of a second.
inline mdat::SetPlan small_plan() { return {52, 1, 2, std::nullopt, 10}; }

// A set that is made once for all tests of a program, which copy what they change.
struct SmallSet {
  PassingFolder folder;
  mdat::BenchmarkSet set = mdat::make_set(small_plan(), folder / "set", true);
  std::filesystem::path path() const { return folder / "set"; }
};
inline const SmallSet& small_set() {
  static const SmallSet set;
  return set;
}

// What `action` throws says; empty where it does not throw.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace lasso::test
