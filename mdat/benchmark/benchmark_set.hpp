// Makes a benchmark set from its plan: bodies, their missions, scans and starts, and the truth, which stays with the tool.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "mdat/benchmark/protocol.hpp"
#include "mdat/missiondb/exact_symmetry.hpp"

namespace lasso::mdat {

struct TrueScan {
  std::string scan;
  Pose T_sensor_target;
  bool determined = false;  // the scan can tell the pose
};

struct TrueBody {
  std::string name;        // of its folder
  std::string kind, what;  // "rock"; a few words
  double size_m = 0;
  ExactSymmetry symmetry;
  std::vector<TrueScan> scans;
};

struct BenchmarkSet {
  Protocol protocol;
  std::vector<TrueBody> truth;
};

// Writes the set into a folder that is made, whole or not at all. The same plan gives the same bytes. Throws InputError (the folder is
// there and not empty, or cannot be written), MissionError or RunError that names the body.
BenchmarkSet make_set(const SetPlan& plan, const std::filesystem::path& folder, bool cached);

// The truth of a set in a folder: it is made again beside, and compared. Throws as read_protocol, check_files, check_made_again and
// make_set.
BenchmarkSet open_set(const std::filesystem::path& folder, bool cached);

}  // namespace lasso::mdat
