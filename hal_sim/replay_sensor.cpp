#include "hal_sim/replay_sensor.hpp"

#include <cmath>

#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

bool near(double a, double b) { return std::abs(a - b) <= kReplayTolerance; }

// Whether a pattern's turn is that of another; modulo a turn.
bool same_turn(double a, double b) { return std::abs(std::remainder(a - b, 1.0)) < 1e-6; }

bool serves(const SensorScan& scan, const ScanPlan& plan) {
  const ScanPlan& then = scan.plan;
  const bool same = then.kind == plan.kind && then.points == plan.points && then.cycles_a == plan.cycles_a &&
                    then.cycles_b == plan.cycles_b && then.duration_us == plan.duration_us && scan.aimed.size() == plan.aimed.size();
  return same && same_turn(then.phase_turns, plan.phase_turns) && near(then.center_x, plan.center_x) &&
         near(then.center_y, plan.center_y) && near(then.half_x, plan.half_x) && near(then.half_y, plan.half_y);
}

}  // namespace

Status SensorRecorder::start(const ScanPlan& plan, TimeUs t_start_us) {
  const Status status = sensor_.start(plan, t_start_us);
  if (status != Status::kOk) return status;
  SensorScan scan;
  scan.sensor = number_;
  scan.plan = plan;
  scan.plan.aimed = {};
  scan.aimed.assign(plan.aimed.begin(), plan.aimed.end());
  scan.t_start_us = t_start_us;
  scan_ = recording_.size();
  open_ = true;
  recording_.push_back(scan);
  return status;
}

SensorPoll SensorRecorder::poll(TimeUs now_us, Span<RangeSample> out) {
  const SensorPoll poll = sensor_.poll(now_us, out);
  if (!open_) return poll;
  SensorScan& scan = recording_[scan_];
  scan.samples.insert(scan.samples.end(), out.begin(), out.begin() + poll.count);
  open_ = poll.status == Status::kOk && !poll.complete;
  if (!open_) scan.end = poll.status;
  return poll;
}

void SensorRecorder::abort() {
  open_ = false;
  sensor_.abort();
}

// Loop bound: the recording.
const SensorScan* ReplaySensor::find(const ScanPlan& plan) {
  for (std::size_t i = 0; i < recording_.size(); ++i) {
    const std::size_t place = (at_ + i) % recording_.size();
    if (recording_[place].sensor != number_ || !serves(recording_[place], plan)) continue;
    if (place < at_) ++rounds_;
    at_ = place + 1;
    return &recording_[place];
  }
  return nullptr;
}

Status ReplaySensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (scan_ != nullptr) return Status::kBusy;
  if (lasso::validate(plan) != Status::kOk) return Status::kBadValue;
  scan_ = find(plan);
  if (scan_ == nullptr) {
    ++unserved_;
    return Status::kBadValue;
  }
  next_ = 0;
  later_us_ = t_start_us - scan_->t_start_us;
  return Status::kOk;
}

SensorPoll ReplaySensor::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll poll;
  poll.status = Status::kNoData;
  if (scan_ == nullptr) return poll;
  poll.status = Status::kOk;
  while (poll.count < out.size() && next_ < scan_->samples.size() && scan_->samples[next_].t_us + later_us_ <= now_us) {
    out[poll.count] = scan_->samples[next_++];
    out[poll.count++].t_us += later_us_;
  }
  if (next_ < scan_->samples.size() || scan_->end == Status::kNoData) return poll;
  poll.complete = scan_->end == Status::kOk;
  if (!poll.complete && poll.count > 0) return poll;  // what was lost says so once all of it is there
  poll.status = scan_->end;
  scan_ = nullptr;
  return poll;
}

}  // namespace lasso::sim
