// The estimation task: one job at a time, handed over at a frame boundary, run by the estimation thread, collected at the next boundary.
// A job is a copy of all it needs except the range image, which nobody else touches while the task is not idle. The hand-over is one
// 32-bit atomic (64-bit ones need a library on the 603e): release after writing, acquire before reading.
#pragma once

#include <atomic>
#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/searcher.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

struct EstimationJob {
  std::uint32_t scan_id = 0;
  const RangeImage* scan = nullptr;  // null: the scan was lost, the filter coasts
  TimeUs t_nominal_us = 0;           // planned middle of the scan, for a lost one
  TrackState before;
  const Mission* mission = nullptr;  // as the scans of the sensor that took it see it, and what follows from that; chosen at the boundary:
  const Parts* parts = nullptr;      // by the time a late job is run, another image may be active
  PartNumber part = kWhole;          // at which the scan looks
  PartNumber part_after = kWhole;    // at which the scan after it looks, whose samples are being collected
  std::uint32_t next_scan_id = 0;    // the first scan that is planned from this job's result
  TimeUs t_next_us = 0;              // planned middle of that scan
};

class EstimationTask {
 public:
  // Acquisition thread, at a boundary. submit() only while idle(), an invariant.
  bool idle() const { return phase_.load(std::memory_order_acquire) == kIdle; }
  void submit(const EstimationJob& job);
  // True, with the step in `step`, when the job is done in time. False when there is none, or when it is late: its result is then
  // dropped whole whenever it comes, and the task stays busy until a later collect() finds it done.
  bool collect(TrackStep& step);
  // The clock has jumped: the result of the job, if there is one, is dropped as that of a late one is.
  void drop() { dropped_ = !idle(); }
  // Where the scan that is planned from the collected step is to look besides its pattern. Acquisition thread, until the next submit().
  const AimedRays& aimed() const { return aimed_; }
  // And at which part of the target. Likewise.
  PartNumber part() const { return part_; }

  // Any thread: a job waits to be run.
  bool pending() const { return phase_.load(std::memory_order_acquire) == kPending; }
  // Estimation thread: runs the pending job, if there is one.
  void run();

 private:
  TrackStep step_of(const Mission& mission, const Parts& parts);
  TrackStep tracked(const Mission& mission, const Parts& parts);

  enum Phase : std::uint32_t { kIdle = 0, kPending = 1, kRunning = 2, kDone = 3 };
  std::atomic<std::uint32_t> phase_{kIdle};
  bool dropped_ = false;  // acquisition thread only
  EstimationJob job_;
  TrackStep step_;
  AimedRays aimed_;
  PartNumber part_ = kWhole;
  Estimator estimator_;
  BearingFinder bearing_finder_;
  Searcher searcher_;
};

}  // namespace lasso
