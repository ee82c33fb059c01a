#include "hal_lcs/driver.hpp"

#include "fsw/core/invariant.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::lcs {
namespace {

constexpr double kBitsPerByte = 10;
constexpr std::size_t kCommandBytes = 128;  // self-test, status, laser, start

double magnitude(double x) { return x < 0 ? -x : x; }

// As the plan, but for its aimed rays, which follow the command.
StartCommand start_command(const ScanPlan& plan) {
  StartCommand command;
  command.aimed = static_cast<std::uint16_t>(plan.aimed.size());
  command.plan = plan;
  return command;
}

std::size_t aim_bytes(const ScanPlan& plan) { return (plan.aimed.size() + kAimedPerFrame - 1) / kAimedPerFrame * kMaxFrame; }

}  // namespace

Driver::Driver(Line& line, const Calibration& calibration)
    : line_(line), calibration_(calibration), triangulation_(calibration, calibration.reference_degC) {
  invariant(validate(calibration) == Status::kOk, "lcs calibration");
}

// --- commands

bool Driver::has_room(std::size_t bytes) const { return line_.to_camera.room() >= bytes; }

void Driver::send(const FrameBytes& frame) {
  invariant(line_.to_camera.write(frame.span()) == frame.size, "lcs line without room");
  ++sent_;
}

void Driver::permit_laser(bool permitted) {
  laser_permitted_ = permitted;
  inhibit_due_ = !permitted;
  if (!permitted && under_way()) lose(Loss::kInhibited, Status::kMissing);
  inhibit();
}

// Until the line takes it.
void Driver::inhibit() {
  if (!inhibit_due_ || !has_room(kMaxFrame)) return;
  send(encode(sent_, LaserCommand::kInhibit));
  camera_.laser_lit = false;
  inhibit_due_ = false;
}

// All that comes before the samples; there is room for it. The camera gets the command when the line has carried what it holds.
void Driver::send_start(const ScanPlan& plan) {
  if (!heard_) send(encode(sent_, Type::kSelfTest));
  send(encode(sent_, Type::kAskStatus));
  if (!camera_.laser_lit) {
    send(encode(sent_, LaserCommand::kArm));
    send(encode(sent_, LaserCommand::kFire));
  }
  start_sequence_ = sent_;
  send(encode(sent_, start_command(plan)));
  const auto bytes = static_cast<double>(kLineBytes - line_.to_camera.room());
  command_us_ = static_cast<DurationUs>(bytes * kBitsPerByte * 1e6 / line_.bits_per_s);
  send_aim(plan.aimed);
}

void Driver::send_aim(Span<const AimedRay> aimed) {
  for (std::size_t first = 0; first < aimed.size(); first += kAimedPerFrame) {
    AimCommand command;
    command.first = static_cast<std::uint16_t>(first);
    const std::size_t left = aimed.size() - first;
    for (command.count = 0; command.count < (left < kAimedPerFrame ? left : kAimedPerFrame); ++command.count) {
      command.rays[command.count] = aimed[first + command.count];
    }
    send(encode(sent_, command));
  }
}

Status Driver::refuse(Loss loss, Status reason) {
  ++health_.scans_lost[static_cast<std::size_t>(loss)];
  return reason;
}

// The next poll says why.
void Driver::lose(Loss loss, Status reason) {
  ++health_.scans_lost[static_cast<std::size_t>(loss)];
  state_ = State::kEnded;
  loss_ = reason;
}

Status Driver::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (under_way()) return Status::kBusy;
  const Status status = validate(plan);
  if (status != Status::kOk) return status;
  if (!laser_permitted_) return refuse(Loss::kInhibited, Status::kMissing);
  tag_ = tag_of(plan.scan_id);
  if (!has_room(kCommandBytes + aim_bytes(plan))) return refuse(Loss::kLineFull, Status::kOverCapacity);
  send_start(plan);
  state_ = State::kStarting;
  loss_ = Status::kOk;
  plan_ = plan;
  t_start_us_ = t_start_us;
  last_us_ = t_start_us;
  next_ = off_plan_ = 0;
  end_seen_ = false;
  pending_.count = taken_ = 0;
  return Status::kOk;
}

void Driver::abort() {
  if (under_way()) {
    ++health_.scans_lost[static_cast<std::size_t>(Loss::kUnfinished)];
    if (has_room(kMaxFrame)) send(encode(sent_, Type::kAbort));  // else the camera is busy at the next start
  }
  state_ = State::kIdle;
}

// --- what the camera says

bool Driver::read_frame(Frame& frame) {
  for (;;) {  // ends with the budget
    const FrameDecoder::Step step = decoder_.step(ConstBytes(chunk_ + chunk_at_, chunk_size_ - chunk_at_), frame);
    chunk_at_ += step.taken;
    if (step.found) return true;
    const std::size_t most = budget_ < kMaxFrame ? budget_ : kMaxFrame;
    chunk_at_ = 0;
    chunk_size_ = line_.from_camera.read(Bytes(chunk_, most));
    if (chunk_size_ == 0) return false;
    budget_ -= chunk_size_;
  }
}

void Driver::receive(const Frame& frame) {
  if (heard_ && frame.sequence != expected_) ++health_.sequence_gaps;
  heard_ = true;
  expected_ = static_cast<std::uint8_t>(frame.sequence + 1);
  const auto decoded = [&](auto message) {
    if (decode(frame, message) != Status::kOk) return false;
    take(message);
    return true;
  };
  bool known = false;
  if (frame.type == static_cast<std::uint8_t>(Type::kAnswer)) known = decoded(Answer{});
  if (frame.type == static_cast<std::uint8_t>(Type::kStatus)) known = decoded(CameraStatus{});
  if (frame.type == static_cast<std::uint8_t>(Type::kSamples)) known = decoded(Samples{});
  if (frame.type == static_cast<std::uint8_t>(Type::kScanEnd)) known = decoded(ScanEnd{});
  if (!known) ++health_.bad_messages;
}

void Driver::take_refusal(Result result) {
  ++health_.refused[static_cast<std::size_t>(result)];
  if (result != Result::kInhibited) return lose(Loss::kRefused, result == Result::kBusy ? Status::kBusy : Status::kBadValue);
  camera_.laser_lit = false;  // lit anew at the next start
  lose(Loss::kInhibited, Status::kMissing);
}

void Driver::take(const Answer& answer) {
  if (answer.to != Type::kStart) return;
  if (state_ != State::kStarting || answer.sequence != start_sequence_) {
    ++health_.strayed;
    return;
  }
  if (answer.result != Result::kDone) return take_refusal(answer.result);
  const TimeUs t_command_us = t_start_us_ + command_us_;
  const DurationUs jump_us = clock_known_ ? time_of(answer.clock_us) - t_command_us : 0;
  if (jump_us > kClockToleranceUs || jump_us < -kClockToleranceUs) ++health_.clock_jumps;
  clock_known_ = true;
  clock_at_us_ = t_command_us;
  clock_us_ = answer.clock_us;
  state_ = State::kScanning;
}

void Driver::take(const CameraStatus& status) {
  const bool booted = camera_.serial != 0 && status.boots != camera_.boots;
  const bool warmer = status.temperature_degC != camera_.temperature_degC;
  camera_ = status;
  if (warmer) triangulation_ = Triangulation(calibration_, static_cast<double>(status.temperature_degC));
  if (booted) {
    ++health_.boots;
    clock_known_ = false;
  }
  if (!under_way()) return;
  if (booted) return lose(Loss::kBooted, Status::kBadOrder);
  if (status.serial != calibration_.serial) lose(Loss::kForeign, Status::kBadVersion);
}

// Samples whose answer to the start was damaged are timed by the clock as it was tied before.
void Driver::take(const Samples& samples) {
  if (state_ == State::kStarting && clock_known_ && samples.tag == tag_) state_ = State::kScanning;
  const bool ours =
      state_ == State::kScanning && samples.tag == tag_ && samples.first >= next_ && samples.first + samples.count <= plan_.points;
  if (!ours) {
    health_.strayed += static_cast<std::uint32_t>(samples.count);
    return;
  }
  pending_ = samples;
  taken_ = 0;
  check_plan(samples);
}

void Driver::check_plan(const Samples& samples) {
  const RawSample& raw = samples.samples[0];
  if (raw.kind == SampleKind::kNotAimed) return;
  const Vec3 planned = pattern_direction(plan_, samples.first);
  const double off_x = tangent(raw.angle_x_rad + calibration_.angle_x_offset_rad) - planned.x() / planned.z();
  const double off_y = tangent(raw.angle_y_rad + calibration_.angle_y_offset_rad) - planned.y() / planned.z();
  if (magnitude(off_x) < kMirrorTolerance && magnitude(off_y) < kMirrorTolerance) return;
  ++health_.off_plan;
  if (++off_plan_ == kOffPlanFrames) lose(Loss::kOffPlan, Status::kBadValue);
}

void Driver::take(const ScanEnd& end) {
  if (state_ != State::kScanning || end.tag != tag_) {
    ++health_.strayed;
    return;
  }
  end_seen_ = true;
  if (!end.whole) lose(Loss::kStopped, Status::kTruncated);
}

// --- samples

TimeUs Driver::time_of(std::uint32_t clock_us) const { return clock_at_us_ + static_cast<std::int32_t>(clock_us - clock_us_); }

RangeSample Driver::sample_of(const RawSample& raw) {
  const TimeUs t_us = time_of(raw.clock_us);
  const DurationUs late_us = t_us - (t_start_us_ + command_us_ + pattern_time_us(plan_, static_cast<std::uint16_t>(next_)));
  RangeSample sample;
  ++health_.fates[static_cast<std::size_t>(triangulation_.convert(raw, t_us, sample))];
  if (t_us >= last_us_ && late_us <= kClockToleranceUs && late_us >= -kClockToleranceUs) {
    last_us_ = t_us;
    return sample;
  }
  ++health_.bad_times;
  sample = RangeSample{};
  sample.t_us = last_us_;
  return sample;
}

// Of the ray next_: as it came, or lost, if a later one is there or the scan has ended.
RangeSample Driver::next_sample() {
  if (taken_ < pending_.count && pending_.first + taken_ == next_) return sample_of(pending_.samples[taken_++]);
  ++health_.samples_lost;
  RangeSample sample;
  sample.state = RayState::kLost;
  sample.t_us = last_us_;
  return sample;
}

// What is known of the scan's next samples, into `out` from `count` on.
std::size_t Driver::hand_over(Span<RangeSample> out, std::size_t count) {
  while (count < out.size() && state_ == State::kScanning && (taken_ < pending_.count || (end_seen_ && next_ < plan_.points))) {
    out[count++] = next_sample();
    ++next_;
  }
  return count;
}

SensorPoll Driver::poll(TimeUs now_us, Span<RangeSample> out) {
  inhibit();
  SensorPoll answer;
  budget_ = kLineBytes;
  Frame frame;
  answer.count = hand_over(out, 0);
  while (answer.count < out.size() && read_frame(frame)) {  // ends with the budget
    receive(frame);
    answer.count = hand_over(out, answer.count);
  }
  if (state_ == State::kStarting && now_us - t_start_us_ > kAnswerTimeoutUs) lose(Loss::kSilent, Status::kTimeout);
  answer.complete = state_ == State::kScanning && next_ == plan_.points;
  if (state_ == State::kEnded) answer.status = loss_;
  if (state_ == State::kIdle) answer.status = Status::kNoData;
  if (answer.complete || state_ == State::kEnded) state_ = State::kIdle;
  return answer;
}

}  // namespace lasso::lcs
