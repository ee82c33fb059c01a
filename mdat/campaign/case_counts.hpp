// What a campaign keeps of a case besides its figures: counts that add up over cases, for distributions over all poses and episodes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/campaign/level_counts.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/time_to_alert.hpp"

namespace lasso::mdat {

struct CaseCounts {
  AlertTimes alert;
  LevelCounts position_m, attitude_rad;  // of valid poses
  void add(const CaseCounts& others);
  bool operator==(const CaseCounts&) const = default;
};
CaseCounts counts_of(const CaseResult& result);

// The cells of a record that hold them, by their names, and their text: a cell each.
std::vector<std::string> count_names();
std::vector<std::string> count_cells(const CaseCounts& counts);
// Nothing where there are not as many cells, or a text is not theirs.
std::optional<CaseCounts> counts_of_cells(const std::vector<std::string_view>& cells);

}  // namespace lasso::mdat
