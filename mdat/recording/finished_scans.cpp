#include "mdat/recording/finished_scans.hpp"

#include <algorithm>

namespace lasso::mdat {

sim::SensorRecording FinishedScans::take(bool all) {
  sim::SensorRecording finished;
  if (!scans_) return finished;
  const auto is_followed = [&](std::size_t at) {
    return std::any_of(scans_->begin() + static_cast<std::ptrdiff_t>(at) + 1, scans_->end(),
                       [&](const sim::SensorScan& later) { return later.sensor == (*scans_)[at].sensor; });
  };
  for (; taken_ < scans_->size() && (all || is_followed(taken_)); ++taken_)
    finished.push_back(std::move((*scans_)[taken_]));  // nobody asks for its samples again
  return finished;
}

}  // namespace lasso::mdat
