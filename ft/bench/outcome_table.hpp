// The comparison for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "ft/bench/comparison.hpp"

namespace lasso::bench {

struct Comparison {
  std::string mission, scenario;
  std::size_t scans = 0;
  std::vector<MethodResult> noise_free, noisy;
};

// Times, accuracy and ratios, without and with noise; then the required figures beside the measured ones.
std::string table_text(const Comparison& comparison);

// Keys as in docs/benchmarks.md.
std::string table_json(const Comparison& comparison);

}  // namespace lasso::bench
