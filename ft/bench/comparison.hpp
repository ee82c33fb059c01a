// One run of all methods over the same scans.
#pragma once

#include "ft/bench/methods.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::bench {

struct MethodResult {
  std::string name;
  bool peer = false;
  mdat::RunStatistics statistics;  // as those of `mdat run`, scans in a row; nees only where the method states a covariance
  mdat::TimeStatistics by_turns;   // of the same scans, when all other methods have run since the last one and the caches hold their data
  double iterations = 0;           // mean
};

// Every method registers all scans in a row, then the next one does, kRounds times over; and then all over again with one scan each. Times
// are processor time of the calling thread. Counts in `bar`: `done` steps were shown before, (kRounds + 1) * scans.size() are added.
constexpr std::size_t kRounds = 3;
std::vector<MethodResult> compare(const std::vector<std::unique_ptr<Method>>& methods, const std::vector<Scan>& scans, std::size_t done,
                                  mdat::ProgressBar& bar);

// Throws RunError where there is none of that name.
const MethodResult& result_of(const std::vector<MethodResult>& results, const std::string& name);

}  // namespace lasso::bench
