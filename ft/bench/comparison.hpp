// One run of all methods over the same scans, scan by scan in turn, so that what disturbs the machine disturbs all of them.
#pragma once

#include "ft/bench/methods.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::bench {

struct MethodResult {
  std::string name;
  bool peer = false;
  mdat::RunStatistics statistics;  // as those of `mdat run`; nees only where the method states a covariance
  double iterations = 0;           // mean
};

// Times are processor time of the calling thread. `done` scans were already shown in the bar. The first scan is registered once before, so
// that nothing is timed that happens only once.
std::vector<MethodResult> compare(const std::vector<std::unique_ptr<Method>>& methods, const std::vector<Scan>& scans, std::size_t done,
                                  mdat::ProgressBar& bar);

// Throws RunError where there is none of that name.
const MethodResult& result_of(const std::vector<MethodResult>& results, const std::string& name);

}  // namespace lasso::bench
