// Recorded scans through the flight component's modes, one after the other.
#pragma once

#include <memory>

#include "fsw/mode/searcher.hpp"
#include "fsw/mode/tracker.hpp"

namespace lasso::mdat {

// Tracks scans as the flight component does, from a pose given for the first of them: a start that a scan confirms is checked by a search
// (start.check), and a track that is lost is looked for as the mission says. But a search is done whole with its scan: a replay has no
// frames in which to go on with it. Scans without times, or with times that do not rise, follow each other by the mission's period.
class ClosedLoop {
 public:
  // Throws RunError where the tracker refuses the pose.
  ClosedLoop(const Mission& mission, const Pose& initial, bool wide);

  // The registration states the scan's own time.
  TrackStep step(const RangeImage& recorded);

 private:
  void move_clock(TimeUs recorded_us);
  const RangeImage& at_clock(const RangeImage& recorded);
  TrackStep step_of(const RangeImage& scan);

  Mission mission_;
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<Searcher> searcher_ = std::make_unique<Searcher>();
  BearingFinder finder_;
  std::unique_ptr<RangeImage> image_ = std::make_unique<RangeImage>();
  TrackState state_;
  TimeUs clock_us_ = 0, last_us_ = 0;
  bool begun_ = false;
};

}  // namespace lasso::mdat
