// The program mdat-match, from the outside: a process that gets two pictures and a calibration as files.
#pragma once

#include <filesystem>
#include <string>

#include "mdat/pair/disparity_map.hpp"

namespace lasso::mdat {

// Depths, along the left camera's z axis, between which a match is looked for.
struct MatchDepths {
  double nearest_m = 0, farthest_m = 0;
};

struct PairFiles {
  std::filesystem::path left, right, calibration;
};

// Where mdat-match is: beside this program, or else where the shell looks.
std::filesystem::path matcher_program();

// A folder of its own, which goes with it.
class ScratchFolder {
 public:
  ScratchFolder();  // throws RunError
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

// Throws RunError where the program is not there (it says which packages and which command make it) or fails, and InputError with its own
// words where it refuses its input.
DisparityMap match_files(const std::filesystem::path& program, const PairFiles& files, const MatchDepths& depths);

}  // namespace lasso::mdat
