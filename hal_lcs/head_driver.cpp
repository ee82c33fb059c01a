#include "hal_lcs/head_driver.hpp"

#include "fsw/core/invariant.hpp"
#include "hal_lcs/plan_check.hpp"

namespace lasso::lcs {
namespace {

void write_aimed(Span<const AimedRay> rays, HeadMemory& head) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ByteWriter out{Bytes(head.aimed[i])};
    out.f32(rays[i].x);
    out.f32(rays[i].y);
  }
}

// Any word but those is a refusal, too.
Status reason_of(std::uint16_t result) {
  if (result == static_cast<std::uint16_t>(Result::kDone)) return Status::kOk;
  if (result == static_cast<std::uint16_t>(Result::kInhibited)) return Status::kMissing;
  return result == static_cast<std::uint16_t>(Result::kBusy) ? Status::kBusy : Status::kBadValue;
}

// Whether there is a whole one, and of which command.
bool read_status(const HeadMemory& head, CameraStatus& status, std::uint8_t& sequence) {
  Frame frame;
  const bool found = head.status.load(frame);
  sequence = frame.sequence;
  return found && decode(frame, status) == Status::kOk;
}

// Before the first one that a new driver gives: that is then neither the last one of the driver before, which may be open yet, nor what the
// head has last answered, whatever the memory holds.
std::uint16_t number_before_first(const HeadMemory& head) {
  const std::uint16_t given = value_of(head.commands.load());
  const auto next = static_cast<std::uint16_t>(given + 1);
  return command_of(head.answer.load()) == next ? next : given;
}

}  // namespace

HeadDriver::HeadDriver(HeadMemory& head, const Optics& optics)
    : head_(head), made_(optics), optics_(optics), commands_(number_before_first(head)) {
  invariant(optics.validate() == Status::kOk, "lcs calibration");
  write_permission();
  inhibit();  // whatever was before
}

// --- what the head is told

// What no two copies say is no permission.
bool HeadDriver::laser_permitted() const {
  std::uint8_t permitted = 0;
  return laser_.get(permitted) && permitted != 0;
}

// Unless a whole status says that it is dark.
bool HeadDriver::may_be_lit() const {
  CameraStatus status;
  std::uint8_t sequence = 0;
  return !read_status(head_, status, sequence) || status.laser_lit;
}

// A word that a disturbance has changed is right again, and the head hears that somebody is there.
void HeadDriver::write_permission() {
  head_.laser.store(laser_permitted() ? kLaserMayShine : 0);
  head_.beats.store(head_.beats.load() + 1);
}

// With each call: a head that may be lit without permission is told by a command, too.
void HeadDriver::show_laser() {
  write_permission();
  if (!laser_permitted() && may_be_lit()) inhibit();
}

void HeadDriver::inhibit() { give(encode(next_sequence(), LaserCommand::kInhibit)); }

// A scan that was forbidden once is lost, whatever is permitted before the next poll. The head is told each time, whatever it says.
void HeadDriver::permit_laser(bool permitted) {
  laser_.set(permitted ? 1 : 0);
  scan_.forbidden = scan_.forbidden || !permitted;
  write_permission();
  if (!permitted) inhibit();
}

// Each scan sets its temperature.
void HeadDriver::use_calibration(const TriangulationCalibration* calibration) {
  optics_ = calibration == nullptr ? made_ : made_.calibrated(*calibration);
}

void HeadDriver::give(const FrameBytes& command) {
  head_.command.store(command);
  head_.commands.store(++commands_);
}

Status HeadDriver::start(const ScanPlan& plan, TimeUs t_start_us) {
  laser_.set(laser_permitted() ? 1 : 0);
  show_laser();
  if (running_) return Status::kBusy;
  const Status status = validate(plan);
  if (status != Status::kOk) return status;
  if (!laser_permitted()) return Status::kMissing;
  running_ = true;
  scan_ = Scan{plan, t_start_us + kStartDelayUs, t_start_us, 0, 0, 0, false, false};
  ByteWriter{Bytes(head_.first_us)}.u64(static_cast<std::uint64_t>(scan_.first_us));
  write_aimed(plan.aimed, head_);
  give(encode(next_sequence(), start_command(plan)));
  return Status::kOk;
}

void HeadDriver::abort() {
  if (running_) give(encode(next_sequence(), Type::kAbort));
  running_ = false;
  show_laser();
}

// --- what it says

// Of this scan's; a word that is of another one counts none.
std::uint32_t HeadDriver::samples_there() const {
  const std::uint32_t samples = head_.samples.load();
  return command_of(samples) == commands_ ? value_of(samples) : 0U;
}

// Of another head than the calibration's nothing is believed. A boot before the scan's first status is of no scan: the head that answered
// is the one that scans.
Status HeadDriver::take(const CameraStatus& status) {
  if (status.serial != optics_.serial() || status.device != optics_.device() || status.version != kProtocolVersion)
    return Status::kBadVersion;
  const bool booted = boots_ != 0 && status.boots != boots_;
  boots_ = status.boots;
  if (booted) ++counters_.restarts;
  if (booted && scan_.begun) return Status::kBadOrder;
  if (!scan_.begun) optics_.set_temperature(static_cast<double>(status.temperature_degC));
  scan_.begun = true;
  scan_.there = samples_there();
  if (scan_.there > scan_.plan.points) return Status::kBadLength;
  return status.scanning || scan_.there == scan_.plan.points ? Status::kOk : Status::kTruncated;
}

// What the head has not said yet of this scan it may say later.
Status HeadDriver::unanswered(TimeUs now_us) const { return now_us - scan_.first_us > kAnswerTimeoutUs ? Status::kTimeout : Status::kOk; }

// Why the scan is lost, if it is.
Status HeadDriver::listen(TimeUs now_us) {
  if (scan_.forbidden || !laser_permitted()) return Status::kMissing;
  const std::uint32_t answer = head_.answer.load();
  if (command_of(answer) != commands_) return unanswered(now_us);
  const Status refusal = reason_of(value_of(answer));
  if (refusal != Status::kOk) return refusal;
  CameraStatus status;
  std::uint8_t sequence = 0;
  if (read_status(head_, status, sequence)) return sequence == sequence_of(commands_) ? take(status) : unanswered(now_us);
  ++counters_.damaged_frames;
  return Status::kOk;
}

SensorPoll HeadDriver::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll answer;
  show_laser();
  answer.status = running_ ? listen(now_us) : Status::kNoData;
  while (answer.status == Status::kOk && answer.count < out.size() && scan_.next < scan_.there) {
    hand_over(out[answer.count++]);
    if (scan_.off_plan == kOffPlanFrames) answer.status = Status::kOffPlan;
  }
  answer.complete = answer.status == Status::kOk && scan_.next == scan_.plan.points;
  if (answer.complete) running_ = false;
  if (answer.status != Status::kOk) abort();
  return answer;
}

void HeadDriver::hand_over(RangeSample& sample) {
  const auto ray = static_cast<std::uint16_t>(scan_.next++);
  ByteReader in{ConstBytes(head_.records[ray])};
  const std::uint32_t clock_us = in.u32();
  RawSample raw;
  if (read_sample(in, clock_us, raw) != Status::kOk) raw.kind = SampleKind::kSaturated;  // makes no statement
  if (ray % kRaysPerPlanCheck == 0 && !follows_plan(scan_.plan, ray, raw, optics_.mirrors())) {
    ++counters_.off_plan;
    ++scan_.off_plan;
  }
  convert(raw, ray, scan_.first_us + static_cast<std::int32_t>(clock_us - static_cast<std::uint32_t>(scan_.first_us)), sample);
}

void HeadDriver::convert(const RawSample& raw, std::uint16_t ray, TimeUs t_us, RangeSample& sample) {
  const Fate fate = optics_.convert(raw, t_us, sample);
  if (follows_time(scan_.plan, ray, scan_.first_us, scan_.last_us, t_us)) {
    scan_.last_us = t_us;
    if (fate == Fate::kBeside) ++counters_.samples_outside;
    if (fate != Fate::kBeside && fate != Fate::kPoint && fate != Fate::kNothing) ++counters_.samples_refused;
    return;
  }
  ++counters_.bad_times;
  sample = invalid_sample(scan_.last_us);
}

}  // namespace lasso::lcs
