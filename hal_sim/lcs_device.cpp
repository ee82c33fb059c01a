#include "hal_sim/lcs_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fsw/sense/pattern.hpp"
#include "hal_lcs/table.hpp"

namespace lasso::sim {
namespace {

constexpr DurationUs kBootUs = 300'000;                            // from a reset to the first answer
constexpr std::uint64_t kChanceOfTheLine = 0x4C43'5346'6175'6C74;  // other than what the rays draw

}  // namespace

LcsDevice::LcsDevice(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                     const LcsCamera& camera, OtherBodies others)
    : rays_(target, trajectory, model, seed, std::move(others)), camera_(camera), chance_(seed ^ kChanceOfTheLine) {
  static_cast<void>(optics_of(camera));
  for (const LcsFault& one : camera.faults) {
    if (one.kind == LcsFaultKind::kReset) reset_at_us_.push_back(one.from_us);
  }
  std::sort(reset_at_us_.begin(), reset_at_us_.end());
}

// The strongest of its kind at that time, 0: none. What has no value counts as 1.
double LcsDevice::fault(LcsFaultKind kind, TimeUs t_us) const {
  double strongest = 0;
  for (const LcsFault& one : camera_.faults) {
    const bool valued = kind != LcsFaultKind::kSilent && kind != LcsFaultKind::kStuckMirror && kind != LcsFaultKind::kSaturated;
    if (one.kind == kind && t_us >= one.from_us && t_us < one.until_us) strongest = std::max(strongest, valued ? one.value : 1.0);
  }
  return strongest;
}

std::uint32_t LcsDevice::clock_us(TimeUs t_us) const {
  double off_us = 0;
  for (const LcsFault& one : camera_.faults) {
    if (t_us < one.from_us) continue;
    if (one.kind == LcsFaultKind::kClockJump) off_us += 1e6 * one.value;
    if (one.kind == LcsFaultKind::kClockRate) off_us += one.value * static_cast<double>(std::min(t_us, one.until_us) - one.from_us);
  }
  const std::int64_t shown_us = t_us + static_cast<std::int64_t>(std::floor(off_us));
  return camera_.clock_us + static_cast<std::uint32_t>(static_cast<std::uint64_t>(shown_us));
}

// --- the line

std::uint8_t LcsDevice::noisy(std::uint8_t byte, TimeUs t_us) {
  const double rate = fault(LcsFaultKind::kBitErrors, t_us);
  if (rate <= 0) return byte;
  unsigned noisy = byte;
  for (unsigned bit = 0; bit < 8; ++bit) noisy ^= chance_.uniform() < rate ? 1U << bit : 0U;
  return static_cast<std::uint8_t>(noisy);
}

// Nobody hears what comes while the camera boots.
void LcsDevice::take_byte(lcs::Line& line) {
  std::uint8_t byte = 0;
  if (line.to_camera.read(Bytes(&byte, 1)) == 0) return;
  inbox_free_us_ += byte_us();
  const auto t_us = static_cast<TimeUs>(std::llround(inbox_free_us_));
  if (!booting(t_us)) inbox_.push_back({t_us, noisy(byte, t_us)});
}

// An idle line begins now; one that is not has carried, by the last run(), what came before.
void LcsDevice::listen(TimeUs t_us, const lcs::Line& line) {
  if (line.to_camera.room() < lcs::kLineBytes) inbox_free_us_ = std::max(inbox_free_us_, static_cast<double>(t_us));
}

// The bytes that the line begins to carry until now_us, one after the other.
void LcsDevice::pull(TimeUs now_us, lcs::Line& line) {
  while (inbox_free_us_ < static_cast<double>(now_us) && line.to_camera.room() < lcs::kLineBytes) take_byte(line);
}

void LcsDevice::send(const lcs::FrameBytes& frame, TimeUs t_us) {
  ++sent_;
  if (failing(LcsFaultKind::kSilent, t_us) || chance_.uniform() < fault(LcsFaultKind::kDrop, t_us)) return;
  lcs::FrameBytes bytes = frame;
  if (chance_.uniform() < fault(LcsFaultKind::kCorrupt, t_us)) {
    const std::uint64_t bit = chance_.bits() % (8 * frame.size);
    bytes.bytes[bit / 8] = static_cast<std::uint8_t>(bytes.bytes[bit / 8] ^ (1U << (bit % 8)));
  }
  const int times = chance_.uniform() < fault(LcsFaultKind::kRepeat, t_us) ? 2 : 1;
  const double begin_us = static_cast<double>(t_us) + 1e6 * fault(LcsFaultKind::kLate, t_us);
  for (int i = 0; i < times; ++i) {
    for (const std::uint8_t byte : bytes.span()) {
      outbox_free_us_ = std::max(outbox_free_us_, begin_us) + byte_us();
      outbox_.push_back({static_cast<TimeUs>(std::llround(outbox_free_us_)), noisy(byte, t_us)});
    }
  }
}

// Loop bound: the resets that the script asks for.
void LcsDevice::run(TimeUs now_us, lcs::Line& line) {
  for (; resets_ < reset_at_us_.size() && reset_at_us_[resets_] <= now_us; ++resets_) {
    live_until(reset_at_us_[resets_], line);
    boot(reset_at_us_[resets_]);
  }
  live_until(now_us, line);
}

void LcsDevice::live_until(TimeUs now_us, lcs::Line& line) {
  pull(now_us, line);
  while (!inbox_.empty() && inbox_.front().t_us <= now_us) {
    const Byte byte = inbox_.front();
    inbox_.pop_front();
    lcs::Frame frame;
    if (!decoder_.step(ConstBytes(&byte.value, 1), frame).found) continue;
    scan_until(byte.t_us);
    heard_us_ = byte.t_us;
    carry_out(frame, byte.t_us);
  }
  scan_until(now_us);
  while (!outbox_.empty() && outbox_.front().t_us <= now_us) {
    static_cast<void>(line.from_camera.write(ConstBytes(&outbox_.front().value, 1)));  // what nobody takes is gone
    outbox_.pop_front();
  }
}

// --- commands

void LcsDevice::answer(const lcs::Frame& to, lcs::Result result, TimeUs t_us) {
  send(lcs::encode(sent_, lcs::Answer{static_cast<lcs::Type>(to.type), to.sequence, result, clock_us(t_us)}), t_us);
}

void LcsDevice::send_status(TimeUs t_us) {
  lcs::CameraStatus status;
  status.serial = optics_of(camera_).serial();
  status.device = camera_.device;
  status.boots = boots_;
  status.clock_us = clock_us(t_us);
  status.temperature_degC = camera_.temperature_degC;
  status.laser_lit = laser_lit_;
  status.scanning = scan_.running;
  send(lcs::encode(sent_, status), t_us);
}

// What it was made with; a LIDAR does not triangulate.
void LcsDevice::send_table(const lcs::Frame& asked, TimeUs t_us) {
  if (camera_.device == lcs::Device::kLidar) return answer(asked, lcs::Result::kUnknown, t_us);
  answer(asked, lcs::Result::kDone, t_us);
  for (std::size_t first = 0; first < lcs::kTableNumbers; first += lcs::kNumbersPerPart)
    send(lcs::encode(sent_, lcs::part_of(camera_.truth, first)), t_us);
}

void LcsDevice::put_out_laser() { laser_lit_ = scan_.running = false; }

void LcsDevice::boot(TimeUs t_us) {
  ++boots_;
  laser_lit_ = false;
  armed_us_ = -1;
  scan_.running = false;
  inbox_.clear();
  outbox_.clear();
  decoder_.clear();
  sent_ = 0;
  up_us_ = heard_us_ = t_us + kBootUs;
  outbox_free_us_ = static_cast<double>(up_us_);
  send_status(up_us_);
}

void LcsDevice::carry_out(const lcs::Frame& frame, TimeUs t_us) {
  using lcs::Result;
  using lcs::Type;
  switch (static_cast<Type>(frame.type)) {
    case Type::kSelfTest:
      return answer(frame, Result::kDone, t_us);
    case Type::kAskStatus:
      return send_status(t_us);
    case Type::kLaser: {
      lcs::LaserCommand command{};
      return answer(frame, decode(frame, command) == Status::kOk ? carry_out(command, t_us) : Result::kUnknown, t_us);
    }
    case Type::kStart: {
      lcs::StartCommand command;
      return answer(frame, decode(frame, command) == Status::kOk ? carry_out(command, t_us) : Result::kUnknown, t_us);
    }
    case Type::kAim: {
      lcs::AimCommand command;
      if (decode(frame, command) == Status::kOk) carry_out(command);
      return;
    }
    case Type::kAskTable:
      return send_table(frame, t_us);
    case Type::kAbort:
      scan_.running = false;
      return answer(frame, Result::kDone, t_us);
    case Type::kAnswer:
    case Type::kStatus:
    case Type::kTable:
    case Type::kSamples:
    case Type::kScanEnd:
      break;
  }
  answer(frame, Result::kUnknown, t_us);
}

lcs::Result LcsDevice::carry_out(lcs::LaserCommand command, TimeUs t_us) {
  const bool armed = armed_us_ >= 0 && t_us - armed_us_ <= lcs::kArmedUs;
  armed_us_ = command == lcs::LaserCommand::kArm ? t_us : -1;
  if (command == lcs::LaserCommand::kInhibit) put_out_laser();
  if (command != lcs::LaserCommand::kFire) return lcs::Result::kDone;
  laser_lit_ = laser_lit_ || armed;
  return armed ? lcs::Result::kDone : lcs::Result::kNotArmed;
}

lcs::Result LcsDevice::carry_out(const lcs::StartCommand& command, TimeUs t_us) {
  if (scan_.running) return lcs::Result::kBusy;
  if (!laser_lit_) return lcs::Result::kInhibited;
  Scan scan;
  scan.command = command;
  scan.aimed.resize(std::min<std::size_t>(command.aimed, kMaxAimedRays));
  scan.aimed_there.resize(scan.aimed.size());
  scan.command.plan.aimed = Span<const AimedRay>(scan.aimed.data(), scan.aimed.size());
  if (scan.aimed.size() != command.aimed || validate(scan.command.plan) != Status::kOk || !within_mirrors(camera_, scan.command.plan)) {
    return lcs::Result::kBadPlan;
  }
  scan.t_first_us = t_us + command.delay_us;
  scan.running = true;
  scan_ = std::move(scan);
  scan_.command.plan.aimed = Span<const AimedRay>(scan_.aimed.data(), scan_.aimed.size());
  return lcs::Result::kDone;
}

void LcsDevice::carry_out(const lcs::AimCommand& command) {
  for (std::size_t i = 0; i < command.count && command.first + i < scan_.aimed.size(); ++i) {
    scan_.aimed[command.first + i] = command.rays[i];
    scan_.aimed_there[command.first + i] = true;
  }
}

// --- scans

TimeUs LcsDevice::sample_time_us(std::uint16_t ray) const { return scan_.t_first_us + pattern_time_us(scan_.command.plan, ray); }

bool LcsDevice::aimed_in_time(std::uint16_t ray) const {
  const std::size_t aimed = static_cast<std::size_t>(ray) - first_aimed(scan_.command.plan);  // wraps below the first
  return aimed >= scan_.aimed.size() || scan_.aimed_there[aimed];
}

Vec3 LcsDevice::direction_of(std::uint16_t ray) const { return pattern_direction(scan_.command.plan, ray); }

lcs::RawSample LcsDevice::measure(std::uint16_t ray) {
  const TimeUs t_us = sample_time_us(ray);
  Vec3 direction = direction_of(ray);
  if (failing(LcsFaultKind::kStuckMirror, t_us)) direction = Vec3(stuck_x_ * direction.z(), direction.y(), direction.z()).normalized();
  stuck_x_ = direction.x() / direction.z();
  const RangeSample seen = rays_.measure(scan_.command.plan.scan_id, ray, direction, t_us);
  lcs::RawSample raw = raw_of(camera_, direction, seen);
  if (failing(LcsFaultKind::kSaturated, t_us) && seen.state != RayState::kMiss) raw.kind = lcs::SampleKind::kSaturated;
  if (!aimed_in_time(ray)) raw.kind = lcs::SampleKind::kNotAimed;
  raw.clock_us = clock_us(t_us);
  return raw;
}

// The ray after the last one of the next frame: four of them, or as many as its 16 bits of time reach.
std::uint16_t LcsDevice::frame_end() const {
  const std::uint32_t first_us = clock_us(sample_time_us(scan_.next));
  const std::size_t most = std::min<std::size_t>(scan_.next + lcs::kSamplesPerFrame, scan_.command.plan.points);
  std::uint16_t end = scan_.next;
  while (end < most && clock_us(sample_time_us(end)) - first_us <= lcs::kMaxSampleOffsetUs) ++end;
  return end;
}

void LcsDevice::send_samples(std::uint16_t end) {
  lcs::Samples samples;
  samples.tag = lcs::tag_of(scan_.command.plan.scan_id);
  samples.first = scan_.next;
  while (scan_.next < end) samples.samples[samples.count++] = measure(scan_.next++);
  send(lcs::encode(sent_, samples), sample_time_us(static_cast<std::uint16_t>(end - 1)));
}

// Each frame when its last sample has been taken; until the dead man's switch puts the laser out.
void LcsDevice::scan_until(TimeUs now_us) {
  const TimeUs dark_us = heard_us_ + lcs::kUnheardUs;
  send_frames_until(std::min(now_us, dark_us));
  if (now_us > dark_us) put_out_laser();
}

void LcsDevice::send_frames_until(TimeUs now_us) {
  while (scan_.running) {
    const std::uint16_t points = scan_.command.plan.points;
    const std::uint16_t end = frame_end();
    const TimeUs t_last_us = sample_time_us(static_cast<std::uint16_t>(end - 1));
    if (t_last_us > now_us) return;
    send_samples(end);
    if (end < points) continue;
    scan_.running = false;
    send(lcs::encode(sent_, lcs::ScanEnd{lcs::tag_of(scan_.command.plan.scan_id), points, true}), t_last_us);
  }
}

// --- camera, line and driver

LcsOverLine::LcsOverLine(LcsDevice& device, const lcs::Optics& optics, double bits_per_s) : device_(device), driver_(line_, optics) {
  line_.bits_per_s = bits_per_s;
}

Status LcsOverLine::start(const ScanPlan& plan, TimeUs t_start_us) {
  device_.run(t_start_us, line_);
  now_us_ = t_start_us;
  const Status status = driver_.start(plan, t_start_us);
  device_.listen(t_start_us, line_);
  return status;
}

void LcsOverLine::abort() {
  driver_.abort();
  device_.listen(now_us_, line_);
}

SensorPoll LcsOverLine::poll(TimeUs now_us, Span<RangeSample> out) {
  device_.run(now_us, line_);
  now_us_ = now_us;
  const SensorPoll poll = driver_.poll(now_us, out);
  device_.listen(now_us, line_);
  return poll;
}

}  // namespace lasso::sim
