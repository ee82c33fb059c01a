#include "fsw/exec/estimation_task.hpp"

#include "fsw/core/invariant.hpp"
#include "fsw/core/renew.hpp"

namespace lasso {

void EstimationTask::submit(const EstimationJob& job) {
  invariant(idle(), "estimation job submitted while busy");
  job_ = job;
  phase_.store(kPending, std::memory_order_release);
}

bool EstimationTask::collect(TrackStep& step) {
  const std::uint32_t phase = phase_.load(std::memory_order_acquire);
  if (phase == kIdle) return false;
  if (phase != kDone) {
    dropped_ = true;
    return false;
  }
  const bool in_time = !dropped_;
  if (in_time) step = step_;
  dropped_ = false;
  phase_.store(kIdle, std::memory_order_release);
  return in_time;
}

TrackStep EstimationTask::step_of(const Mission& mission, const Parts& parts) {
  TrackStep step = tracked(mission, parts);
  step.parts.scanned = job_.part;
  if (properties(job_.before.mode).searches) searcher_.work(mission, job_.scan, estimator_.workspace(), step);
  if (step.after.check.stage == StartCheck::Stage::kSearching) searcher_.check(mission, job_.scan, estimator_.workspace(), step);
  return step;
}

TrackStep EstimationTask::tracked(const Mission& mission, const Parts& parts) {
  const ModeProperties& mode = properties(job_.before.mode);
  const bool says_too_little = job_.part != kWhole && mode.confirms;  // a part that was on its way confirms no pose of the whole
  if (job_.scan == nullptr || says_too_little)
    return track_without_scan(mission, PoseReason::kNoScan, job_.scan_id, job_.t_nominal_us, job_.before);
  if (mode.full_field || mode.searches) return bearing_scan(mission, bearing_finder_, *job_.scan, job_.before);
  if (job_.part != kWhole) return track_part(mission, parts, job_.part, estimator_, *job_.scan, job_.before);
  return track_scan(mission, estimator_, *job_.scan, job_.before);
}

void EstimationTask::run() {
  if (!pending()) return;
  phase_.store(kRunning, std::memory_order_release);
  const Mission& mission = *job_.mission;
  const Parts& parts = *job_.parts;
  renew(step_, [&] { return step_of(mission, parts); });
  part_ = next_part(mission, parts, job_.part_after, job_.next_scan_id, job_.t_next_us, step_);
  aimed_.clear();
  if (part_ == kWhole) aim_next(mission, estimator_, step_, job_.next_scan_id, job_.t_next_us, aimed_);
  phase_.store(kDone, std::memory_order_release);
}

}  // namespace lasso
