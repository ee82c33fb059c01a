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

Driver::Driver(Line& line, const Optics& optics) : line_(line), made_(optics), optics_(optics) {
  invariant(optics.validate() == Status::kOk, "lcs calibration");
  inhibit();  // whatever was before
}

// --- commands

bool Driver::has_room(std::size_t bytes) const { return line_.to_camera.room() >= bytes; }

void Driver::send(const FrameBytes& frame) {
  invariant(line_.to_camera.write(frame.span()) == frame.size, "lcs line without room");
  ++sent_;
}

void Driver::permit_laser(bool permitted) {
  laser_.set(permitted ? 1 : 0);
  if (permitted) return;
  inhibit_due_ = true;
  if (under_way()) lose(Loss::kInhibited, Status::kMissing);
  inhibit();
}

// What no two copies say is no permission.
bool Driver::laser_permitted() const {
  std::uint8_t permitted = 0;
  return laser_.get(permitted) && permitted != 0;
}

// With each call, until the camera has confirmed it.
void Driver::inhibit() {
  if (laser_permitted() || !inhibit_due_ || !has_room(kMaxFrame)) return;
  inhibit_sequence_ = sent_;
  send(encode(sent_, LaserCommand::kInhibit));
  camera_.laser_lit = false;  // so that the next start lights it
}

// All that comes before the samples; there is room for it. The camera gets the command when the line has carried what it holds.
void Driver::send_start(const ScanPlan& plan, TimeUs t_start_us) {
  if (!heard_) send(encode(sent_, Type::kSelfTest));
  send(encode(sent_, Type::kAskStatus));
  if (!camera_.laser_lit || may_be_dark(t_start_us)) {
    send(encode(sent_, LaserCommand::kArm));
    send(encode(sent_, LaserCommand::kFire));
  }
  send_start_command(plan);
  spoken_us_ = t_start_us;
  send_aim(plan.aimed);
}

// The first sample is to be taken kStartDelayUs after the start, whatever else the line has to carry before.
void Driver::send_start_command(const ScanPlan& plan) {
  StartCommand command = start_command(plan);
  const std::size_t bytes = kLineBytes - line_.to_camera.room() + encode(sent_, command).size;
  command_us_ = static_cast<DurationUs>(static_cast<double>(bytes) * kBitsPerByte * 1e6 / line_.bits_per_s + 0.5);
  first_us_ = command_us_ < kStartDelayUs ? kStartDelayUs : command_us_;
  command.delay_us = static_cast<std::uint32_t>(first_us_ - command_us_);
  start_sequence_ = sent_;
  send(encode(sent_, command));
}

// A camera that hears nothing puts its laser out, in a long scan, too.
void Driver::keep_lit(TimeUs now_us) {
  if (!under_way() || !may_be_dark(now_us) || !has_room(2 * kMaxFrame)) return;
  send(encode(sent_, Type::kAskStatus));
  spoken_us_ = now_us;
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

// The next poll says why; the camera stops at once.
void Driver::lose(Loss loss, Status reason) {
  ++health_.scans_lost[static_cast<std::size_t>(loss)];
  state_ = State::kEnded;
  loss_ = reason;
  stop_camera();
}

// Each scan sets its temperature.
void Driver::use_calibration(const TriangulationCalibration* calibration) {
  optics_ = calibration == nullptr ? made_ : made_.calibrated(*calibration);
}

// There is always room left for an inhibit.
void Driver::stop_camera() {
  if (has_room(2 * kMaxFrame)) send(encode(sent_, Type::kAbort));
}

Status Driver::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (under_way()) return Status::kBusy;
  const Status status = validate(plan);
  if (status != Status::kOk) return status;
  state_ = State::kIdle;
  listen();
  inhibit();
  laser_.set(laser_permitted() ? 1 : 0);
  if (!laser_permitted()) return refuse(Loss::kInhibited, Status::kMissing);
  tag_ = tag_of(plan.scan_id);
  if (!has_room(kCommandBytes + aim_bytes(plan) + kMaxFrame)) return refuse(Loss::kLineFull, Status::kOverCapacity);
  send_start(plan, t_start_us);
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
  if (under_way()) stop_camera();
  state_ = State::kIdle;
  inhibit();
}

SensorCounters Driver::counters() const {
  const FrameDecoder::Counters& line = decoder_.counters();
  SensorCounters counters;
  counters.frames = line.frames;
  counters.damaged_frames = line.bad_crc + line.bad_length;
  counters.missing_frames = health_.sequence_gaps;
  counters.repeated_frames = health_.repeated;
  counters.unknown_frames = health_.bad_messages;
  counters.strayed = health_.strayed;
  counters.samples_lost = health_.samples_lost;
  for (const Fate fate : {Fate::kNoStatement, Fate::kBadAngle, Fate::kBadPeak, Fate::kOutside})
    counters.samples_refused += health_.fates[static_cast<std::size_t>(fate)];
  counters.samples_outside = health_.fates[static_cast<std::size_t>(Fate::kBeside)];
  counters.bad_times = health_.bad_times;
  counters.off_plan = health_.off_plan;
  counters.clock_jumps = health_.clock_jumps;
  counters.restarts = health_.boots;
  return counters;
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

// What came while no scan ran.
void Driver::listen() {
  budget_ = kLineBytes;
  Frame frame;
  while (read_frame(frame)) receive(frame);  // ends with the budget
}

void Driver::receive(const Frame& frame) {
  const bool again = static_cast<std::uint8_t>(frame.sequence + 1) == expected_;
  if (heard_ && again) ++health_.repeated;
  if (heard_ && !again && frame.sequence != expected_) ++health_.sequence_gaps;
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
  if (answer.to == Type::kLaser && answer.sequence == inhibit_sequence_) inhibit_due_ = inhibit_due_ && answer.result != Result::kDone;
  if (answer.to != Type::kStart) return;
  if (state_ != State::kStarting || answer.sequence != start_sequence_) {
    ++health_.strayed;
    return;
  }
  if (answer.result != Result::kDone) return take_refusal(answer.result);
  const TimeUs t_command_us = t_start_us_ + command_us_;
  if (clock_known_ && jumped(answer.clock_us, t_command_us)) ++health_.clock_jumps;
  clock_known_ = true;
  clock_at_us_ = t_command_us;
  clock_us_ = answer.clock_us;
  begin();
}

// Whether the camera's clock has gone otherwise than ours since they were tied; modulo its wrap, and with a thousandth of drift.
bool Driver::jumped(std::uint32_t clock_us, TimeUs t_us) const {
  const DurationUs elapsed_us = t_us - clock_at_us_;
  const std::int64_t off_us = static_cast<std::int32_t>(clock_us - clock_us_ - static_cast<std::uint32_t>(elapsed_us));
  const DurationUs tolerance_us = kClockToleranceUs + elapsed_us / 1000;
  return off_us > tolerance_us || off_us < -tolerance_us;
}

bool Driver::known_head() const {
  return camera_.serial == optics_.serial() && camera_.device == optics_.device() && camera_.version == kProtocolVersion;
}

// The camera scans. Of another one than the calibration's nothing is believed.
void Driver::begin() {
  if (!known_head()) return lose(Loss::kForeign, Status::kBadVersion);
  optics_.set_temperature(static_cast<double>(camera_.temperature_degC));
  state_ = State::kScanning;
}

void Driver::take(const CameraStatus& status) {
  const bool booted = camera_.serial != 0 && status.boots != camera_.boots;
  camera_ = status;
  inhibit_due_ = inhibit_due_ || status.laser_lit;  // counts without permission only
  if (!booted) {
    if (state_ == State::kScanning && !known_head()) lose(Loss::kForeign, Status::kBadVersion);
    return;
  }
  ++health_.boots;
  clock_known_ = false;
  if (under_way()) lose(Loss::kBooted, Status::kBadOrder);
}

// Samples whose answer to the start was damaged are timed by the clock as it was tied before, unless that is long ago.
void Driver::take(const Samples& samples) {
  const bool timed = clock_known_ && t_start_us_ - clock_at_us_ < kTieUs;
  if (state_ == State::kStarting && timed && samples.tag == tag_) begin();
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
  const Mirrors mirrors = optics_.mirrors();
  const double off_x = tangent(raw.angle_x_rad + mirrors.x_offset_rad) - planned.x() / planned.z();
  const double off_y = tangent(raw.angle_y_rad + mirrors.y_offset_rad) - planned.y() / planned.z();
  if (magnitude(off_x) < kMirrorTolerance && magnitude(off_y) < kMirrorTolerance) return;
  ++health_.off_plan;
  if (++off_plan_ == kOffPlanFrames) lose(Loss::kOffPlan, Status::kOffPlan);
}

void Driver::take(const ScanEnd& end) {
  if (end.tag != tag_) ++health_.strayed;
  if (state_ != State::kScanning || end.tag != tag_) return;  // the one of a scan that is complete tells nothing new
  end_seen_ = true;
  if (!end.whole) lose(Loss::kStopped, Status::kTruncated);
}

// --- samples

TimeUs Driver::time_of(std::uint32_t clock_us) const { return clock_at_us_ + static_cast<std::int32_t>(clock_us - clock_us_); }

void Driver::convert(const RawSample& raw, RangeSample& sample) {
  const TimeUs t_us = time_of(raw.clock_us);
  const DurationUs late_us = t_us - (t_start_us_ + first_us_ + pattern_time_us(plan_, static_cast<std::uint16_t>(next_)));
  const Fate fate = optics_.convert(raw, t_us, sample);
  if (t_us >= last_us_ && late_us <= kClockToleranceUs && late_us >= -kClockToleranceUs) {
    last_us_ = t_us;
    ++health_.fates[static_cast<std::size_t>(fate)];
    return;
  }
  ++health_.bad_times;
  sample = RangeSample{};
  sample.t_us = last_us_;
}

// Of the ray next_: as it came, or lost, if a later one is there or the scan has ended.
void Driver::next_sample(RangeSample& sample) {
  if (taken_ < pending_.count && pending_.first + taken_ == next_) return convert(pending_.samples[taken_++], sample);
  ++health_.samples_lost;
  sample = RangeSample{};
  sample.state = RayState::kLost;
  sample.t_us = last_us_;
}

// What is known of the scan's next samples, into `out` from `count` on.
std::size_t Driver::hand_over(Span<RangeSample> out, std::size_t count) {
  while (count < out.size() && state_ == State::kScanning && (taken_ < pending_.count || (end_seen_ && next_ < plan_.points))) {
    next_sample(out[count++]);
    ++next_;
  }
  return count;
}

SensorPoll Driver::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll answer;
  budget_ = kLineBytes;
  Frame frame;
  answer.count = hand_over(out, 0);
  while (answer.count < out.size() && read_frame(frame)) {  // ends with the budget
    receive(frame);
    answer.count = hand_over(out, answer.count);
  }
  inhibit();
  keep_lit(now_us);
  if (state_ == State::kStarting && now_us - t_start_us_ > kAnswerTimeoutUs) lose(Loss::kSilent, Status::kTimeout);
  answer.complete = state_ == State::kScanning && next_ == plan_.points;
  if (state_ == State::kEnded) answer.status = loss_;
  if (state_ == State::kIdle) answer.status = Status::kNoData;
  if (answer.complete || state_ == State::kEnded) state_ = State::kIdle;
  return answer;
}

}  // namespace lasso::lcs
