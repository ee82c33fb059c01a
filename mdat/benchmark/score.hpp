// How well a program does on a benchmark set: each of its poses is judged, and counted (docs/benchmark-protocol.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mdat/benchmark/benchmark_set.hpp"
#include "mdat/benchmark/program_poses.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/run/symmetric_error.hpp"

namespace lasso::mdat {

enum class ScanVerdict : std::uint8_t {
  kRight = 0,     // valid and near (is_far is false)
  kAdmitted = 1,  // valid and far, as its covariance says
  kWrong = 2,     // valid and wrong; without a covariance valid and far
  kRefused = 3    // not valid, or without a row
};
const char* to_string(ScanVerdict verdict);

struct ScanScore {
  std::string body, scan;
  bool determined = false;
  ScanVerdict verdict = ScanVerdict::kRefused;
  SymmetricError error;  // of a valid pose; `squared` is not a number where no covariance is stated
};

struct ScoreCounts {
  std::size_t scans = 0, valid = 0, wrong = 0;  // of all scans
  // Of those that are determined, which these four add up to.
  std::size_t determined = 0, right = 0, admitted = 0, determined_wrong = 0, refused = 0;

  void add(const ScanScore& scan);
};

struct BodyScore {
  std::string name, kind, what;
  double size_m = 0;
  ScoreCounts counts;
  double nees = 0;  // mean over valid poses; not a number where there is none, or no covariance
};

struct Score {
  std::string program;
  bool covariances = false;  // the program states them
  ScoreCounts counts;
  std::size_t missing = 0;                 // scans without a row: refused
  double nees_median = 0, nees_worst = 0;  // over the bodies that have one; not a number where none has
  std::string nees_worst_body;
  std::size_t timed = 0;          // rows that state a time
  TimeStatistics time;            // of these; not to be looked at where there is none
  std::vector<BodyScore> bodies;  // in the set's order
  std::size_t worst_body = 0;     // its place there: most wrong poses, then least right ones of those determined, then largest NEES
  std::vector<ScanScore> scans;   // in the set's order
};

// `poses` are as read_program_poses gives them for this set.
Score score(const BenchmarkSet& set, const ProgramPoses& poses);

}  // namespace lasso::mdat
