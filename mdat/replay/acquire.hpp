// Searches each recorded scan for the target on its own, without any prior attitude.
#pragma once

#include <string>
#include <vector>

#include "fsw/mission/mission.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/replay/pose_errors.hpp"

namespace lasso::mdat {

struct AcquiredScan {
  std::string scan;  // stem
  SearchResult result;
  Status status = Status::kOk;  // why the search did not take the scan
  std::string why;              // of the outcome, in words (search_words.hpp)
  double search_us = 0;         // processor time of the whole search
  KnownError errors;
};

// In natural order. Throws sim::ScanFileError.
std::vector<AcquiredScan> acquire(const Mission& mission, const sim::RecordedScans& scans, const std::vector<InitialPose>& truth);

// One row a scan: outcome, reason, pose, ratio, disagreement, the number of candidates, and why; with the columns of errors where any is
// known.
std::string acquired_csv(const std::vector<AcquiredScan>& scans);

// One row a candidate of each scan: pose, disagreement and score (smaller is better), the best first.
std::string candidates_csv(const std::vector<AcquiredScan>& scans);

// How many were accepted, ambiguous and rejected, the time of a search, and of the first ten scans why.
std::string acquired_summary(const std::vector<AcquiredScan>& scans);

}  // namespace lasso::mdat
