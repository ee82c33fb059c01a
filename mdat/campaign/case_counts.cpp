#include "mdat/campaign/case_counts.hpp"

namespace lasso::mdat {

void CaseCounts::add(const CaseCounts& others) {
  alert.add(others.alert);
  position_m.add(others.position_m);
  attitude_rad.add(others.attitude_rad);
}

CaseCounts counts_of(const CaseResult& result) {
  CaseCounts counts;
  counts.alert = alert_times(result.frames, result.end_s);
  for (const FrameError& frame : result.frames) {
    if (!frame.valid) continue;
    counts.position_m.add(frame.level.position_m, frame.registration.translation_m.norm());
    counts.attitude_rad.add(frame.level.attitude_rad, frame.registration.rotation_rad);
  }
  return counts;
}

std::vector<std::string> count_names() { return {"time_to_alert_ms", "position_levels_m", "attitude_levels_rad"}; }

std::vector<std::string> count_cells(const CaseCounts& counts) {
  return {counts.alert.text(), counts.position_m.text(), counts.attitude_rad.text()};
}

std::optional<CaseCounts> counts_of_cells(const std::vector<std::string_view>& cells) {
  if (cells.size() != count_names().size()) return std::nullopt;
  const std::optional<AlertTimes> alert = AlertTimes::of(cells[0]);
  const std::optional<LevelCounts> position_m = LevelCounts::of(cells[1]), attitude_rad = LevelCounts::of(cells[2]);
  if (!alert || !position_m || !attitude_rad) return std::nullopt;
  return CaseCounts{*alert, *position_m, *attitude_rad};
}

}  // namespace lasso::mdat
