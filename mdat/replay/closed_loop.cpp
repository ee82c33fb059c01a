#include "mdat/replay/closed_loop.hpp"

#include <cmath>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr double kWholeSearch = 2e9;  // units of work: more than any search takes

}  // namespace

ClosedLoop::ClosedLoop(const Mission& mission, const Pose& initial, bool wide) : mission_(mission) {
  if (wide) mission_.parameters.wide_start = 1;
  mission_.parameters.search_slice = kWholeSearch;
  const StartRefusal refusal =
      start_track(mission_, InitialPoseSource::kUplink, rough_offer(mission_.parameters, initial, Twist(), 0), 0, state_);
  if (refusal != StartRefusal::kNone) throw RunError(std::string("the tracker refused the initial pose: ") + to_string(refusal));
}

TrackStep ClosedLoop::step(const RangeImage& recorded) {
  const TimeUs recorded_us = recorded.reference_time_us();
  move_clock(recorded_us);
  TrackStep step = step_of(at_clock(recorded));
  state_ = step.after;
  step.registration.t_us = recorded_us;
  return step;
}

void ClosedLoop::move_clock(TimeUs recorded_us) {
  const auto period_us = static_cast<DurationUs>(std::llround(mission_.parameters.period_s * 1e6));
  if (begun_) clock_us_ += recorded_us > last_us_ ? recorded_us - last_us_ : period_us;
  begun_ = true;
  last_us_ = recorded_us;
}

const RangeImage& ClosedLoop::at_clock(const RangeImage& recorded) {
  *image_ = recorded;
  const DurationUs shift_us = clock_us_ - recorded.reference_time_us();
  for (RangeSample& sample : image_->samples) sample.t_us += shift_us;
  return *image_;
}

// As EstimationTask does. A check takes its scan in one call, and searches it in the next.
TrackStep ClosedLoop::step_of(const RangeImage& scan) {
  const ModeProperties& mode = properties(state_.mode);
  if (!mode.scans) return no_track(scan.scan_id, state_);
  Workspace& workspace = estimator_->workspace();
  if (mode.full_field || mode.searches) {
    TrackStep step = bearing_scan(mission_, finder_, scan, state_);
    if (mode.searches) searcher_->work(mission_, &scan, workspace, step);
    return step;
  }
  TrackStep step = track_scan(mission_, *estimator_, scan, state_);
  while (step.after.check.stage == StartCheck::Stage::kSearching) searcher_->check(mission_, &scan, workspace, step);
  return step;
}

}  // namespace lasso::mdat
