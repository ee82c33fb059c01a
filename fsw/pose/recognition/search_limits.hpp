// What a search looks at, how much it may work, and when it accepts a pose. No mission sets these: they belong to the score and to the
// stages of the search, and were measured with them (docs/decisions/search.md, docs/experiments/2026-11-26-search.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lasso {

constexpr std::size_t kMaxSearchScans = 3;
constexpr std::size_t kSubsetHits = 224;  // returns of a scan that are looked at: the first of them are as far apart as any as many

struct SearchLimits {
  // Returns looked at, of all scans. Fewer are too few for disagreement and ratio to tell another spacecraft from the target.
  double hits_min = 80;
  // Share of what was looked at that an accepted pose may leave unexplained: arrays 5 deg off leave 0.05, a cylinder or a sphere more than
  // 0.4.
  double disagreement_max = 0.20;
  // Score of the best distinct competitor over that of the pose, or what the returns make of both by their noise: a target with an exact
  // two-fold symmetry stays below 1.05.
  double ratio_min = 1.3;
  // Scans that one search joins before it begins anew.
  std::uint32_t scans_max = kMaxSearchScans;
  // Units of work on all scans: most searches take 1.2 million, and the dearest end within 200 million instructions (docs/search.md). What
  // they leave open makes the result ambiguous.
  std::uint32_t work_max = 2'500'000;
};

}  // namespace lasso
