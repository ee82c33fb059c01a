#include "hal_lcs/driver.hpp"

#include "fsw/core/invariant.hpp"
#include "hal_lcs/plan_check.hpp"

namespace lasso::lcs {
namespace {

constexpr double kBitsPerByte = 10;
constexpr std::size_t kCommandBytes = 128;  // self-test, status, laser, start

std::size_t aim_bytes(const ScanPlan& plan) { return (plan.aimed.size() + kAimedPerFrame - 1) / kAimedPerFrame * kMaxFrame; }

}  // namespace

Driver::Driver(Line& line, const Optics& optics) : line_(line), made_(optics), optics_(optics), reader_(line.from_camera) {
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
  scan_.command_us = static_cast<DurationUs>(static_cast<double>(bytes) * kBitsPerByte * 1e6 / line_.bits_per_s + 0.5);
  scan_.first_us = scan_.command_us < kStartDelayUs ? kStartDelayUs : scan_.command_us;
  command.delay_us = static_cast<std::uint32_t>(scan_.first_us - scan_.command_us);
  scan_.start_sequence = sent_;
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
  scan_.tag = tag_of(plan.scan_id);
  if (!has_room(kCommandBytes + aim_bytes(plan) + kMaxFrame)) return refuse(Loss::kLineFull, Status::kOverCapacity);
  send_start(plan, t_start_us);
  state_ = State::kStarting;
  loss_ = Status::kOk;
  scan_.plan = plan;
  scan_.t_start_us = t_start_us;
  scan_.last_us = t_start_us;
  scan_.next = scan_.off_plan = 0;
  scan_.end_seen = false;
  scan_.pending.count = scan_.taken = 0;
  return Status::kOk;
}

void Driver::abort() {
  if (under_way()) stop_camera();
  state_ = State::kIdle;
  inhibit();
}

SensorCounters Driver::counters() const {
  const FrameDecoder::Counters& line = reader_.counters();
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

// What came while no scan ran.
void Driver::listen() {
  reader_.renew_budget();
  Frame frame;
  while (reader_.read(frame)) receive(frame);  // ends with the budget
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
  if (state_ != State::kStarting || answer.sequence != scan_.start_sequence) {
    ++health_.strayed;
    return;
  }
  if (answer.result != Result::kDone) return take_refusal(answer.result);
  const TimeUs t_command_us = scan_.t_start_us + scan_.command_us;
  if (tie_.jumped(answer.clock_us, t_command_us)) ++health_.clock_jumps;
  tie_.tie(answer.clock_us, t_command_us);
  begin();
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
  tie_.forget();
  if (under_way()) lose(Loss::kBooted, Status::kBadOrder);
}

// Samples whose answer to the start was damaged are timed by the clock as it was tied before, unless that is long ago.
void Driver::take(const Samples& samples) {
  if (state_ == State::kStarting && tie_.serves(scan_.t_start_us) && samples.tag == scan_.tag) begin();
  const bool ours = state_ == State::kScanning && samples.tag == scan_.tag && samples.first >= scan_.next &&
                    samples.first + samples.count <= scan_.plan.points;
  if (!ours) {
    health_.strayed += static_cast<std::uint32_t>(samples.count);
    return;
  }
  scan_.pending = samples;
  scan_.taken = 0;
  check_plan(samples);
}

void Driver::check_plan(const Samples& samples) {
  if (follows_plan(scan_.plan, samples.first, samples.samples[0], optics_.mirrors())) return;
  ++health_.off_plan;
  if (++scan_.off_plan == kOffPlanFrames) lose(Loss::kOffPlan, Status::kOffPlan);
}

void Driver::take(const ScanEnd& end) {
  if (end.tag != scan_.tag) ++health_.strayed;
  if (state_ != State::kScanning || end.tag != scan_.tag) return;  // the one of a scan that is complete tells nothing new
  scan_.end_seen = true;
  if (!end.whole) lose(Loss::kStopped, Status::kTruncated);
}

// --- samples

void Driver::convert(const RawSample& raw, RangeSample& sample) {
  const TimeUs t_us = tie_.time_of(raw.clock_us);
  const Fate fate = optics_.convert(raw, t_us, sample);
  if (follows_time(scan_.plan, static_cast<std::uint16_t>(scan_.next), scan_.t_start_us + scan_.first_us, scan_.last_us, t_us)) {
    scan_.last_us = t_us;
    ++health_.fates[static_cast<std::size_t>(fate)];
    return;
  }
  ++health_.bad_times;
  sample = invalid_sample(scan_.last_us);
}

// Of the ray scan_.next: as it came, or lost, if a later one is there or the scan has ended.
void Driver::next_sample(RangeSample& sample) {
  if (scan_.taken < scan_.pending.count && scan_.pending.first + scan_.taken == scan_.next)
    return convert(scan_.pending.samples[scan_.taken++], sample);
  ++health_.samples_lost;
  sample = invalid_sample(scan_.last_us);
  sample.state = RayState::kLost;
}

// What is known of the scan's next samples, into `out` from `count` on.
std::size_t Driver::hand_over(Span<RangeSample> out, std::size_t count) {
  while (count < out.size() && state_ == State::kScanning &&
         (scan_.taken < scan_.pending.count || (scan_.end_seen && scan_.next < scan_.plan.points))) {
    next_sample(out[count++]);
    ++scan_.next;
  }
  return count;
}

SensorPoll Driver::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll answer;
  reader_.renew_budget();
  Frame frame;
  answer.count = hand_over(out, 0);
  while (answer.count < out.size() && reader_.read(frame)) {  // ends with the budget
    receive(frame);
    answer.count = hand_over(out, answer.count);
  }
  inhibit();
  keep_lit(now_us);
  if (state_ == State::kStarting && now_us - scan_.t_start_us > kAnswerTimeoutUs) lose(Loss::kSilent, Status::kTimeout);
  answer.complete = state_ == State::kScanning && scan_.next == scan_.plan.points;
  if (state_ == State::kEnded) answer.status = loss_;
  if (state_ == State::kIdle) answer.status = Status::kNoData;
  if (answer.complete || state_ == State::kEnded) state_ = State::kIdle;
  return answer;
}

}  // namespace lasso::lcs
