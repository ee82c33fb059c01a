#include "hal_sim/memory_head.hpp"

#include <atomic>
#include <utility>

#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

std::vector<AimedRay> read_aimed(const lcs::HeadMemory& memory, std::size_t count) {
  std::vector<AimedRay> rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    ByteReader in{ConstBytes(memory.aimed[i])};
    rays[i].x = in.f32();
    rays[i].y = in.f32();
  }
  return rays;
}

}  // namespace

MemoryHead::MemoryHead(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed,
                       const LcsCamera& camera, OtherBodies others)
    : rays_(target, trajectory, model, seed, std::move(others)), camera_(camera) {
  static_cast<void>(optics_of(camera));
}

void MemoryHead::run(TimeUs now_us, lcs::HeadMemory& memory) {
  watch_laser(now_us, memory);
  std::uint32_t answer = memory.answer.load();
  command_ = lcs::value_of(memory.commands.load());
  if (command_ != lcs::command_of(answer)) {
    running_ = false;
    memory.samples.store(lcs::numbered(command_, 0));
    answer = lcs::numbered(command_, static_cast<std::uint16_t>(carry_out(memory)));
  }
  scan_until(now_us, memory);
  tell_status(now_us, memory);
  memory.answer.store(answer);
}

// Its processor may hang: a head that nobody speaks to is dark.
void MemoryHead::watch_laser(TimeUs now_us, const lcs::HeadMemory& memory) {
  const std::uint32_t beats = memory.beats.load();
  if (beats_ && *beats_ != beats) heard_us_ = now_us;
  beats_ = beats;
  permitted_ = memory.laser.load() == lcs::kLaserMayShine && heard_us_ && now_us - *heard_us_ <= lcs::kUnheardUs;
  running_ = running_ && lit();
}

// A frame that is not the command's own is one that is being written.
lcs::Result MemoryHead::carry_out(const lcs::HeadMemory& memory) {
  lcs::Frame frame;
  lcs::StartCommand command;
  if (!memory.command.load(frame) || frame.sequence != lcs::sequence_of(command_)) return lcs::Result::kUnknown;
  if (frame.type == static_cast<std::uint8_t>(lcs::Type::kAbort)) return lcs::Result::kDone;
  if (frame.type == static_cast<std::uint8_t>(lcs::Type::kLaser)) return inhibit(frame);
  if (frame.type != static_cast<std::uint8_t>(lcs::Type::kStart) || decode(frame, command) != Status::kOk) return lcs::Result::kUnknown;
  return start(command, memory);
}

// Nothing arms and fires here.
lcs::Result MemoryHead::inhibit(const lcs::Frame& frame) {
  lcs::LaserCommand command{};
  if (decode(frame, command) != Status::kOk || command != lcs::LaserCommand::kInhibit) return lcs::Result::kUnknown;
  inhibited_ = true;
  return lcs::Result::kDone;
}

// What is read is of this command only if no other was given meanwhile.
lcs::Result MemoryHead::start(const lcs::StartCommand& command, const lcs::HeadMemory& memory) {
  inhibited_ = false;
  if (!lit()) return lcs::Result::kInhibited;
  if (command.aimed > kMaxAimedRays) return lcs::Result::kBadPlan;
  aimed_ = read_aimed(memory, command.aimed);
  plan_ = command.plan;
  plan_.aimed = Span<const AimedRay>(aimed_.data(), aimed_.size());
  if (validate(plan_) != Status::kOk || !within_mirrors(camera_, plan_)) return lcs::Result::kBadPlan;
  first_us_ = static_cast<TimeUs>(ByteReader{ConstBytes(memory.first_us)}.u64());
  std::atomic_thread_fence(std::memory_order_acquire);
  if (lcs::value_of(memory.commands.load()) != command_) return lcs::Result::kUnknown;
  next_ = 0;
  running_ = true;
  return lcs::Result::kDone;
}

void MemoryHead::measure(TimeUs t_us, lcs::HeadMemory& memory) {
  const Vec3 direction = pattern_direction(plan_, next_);
  lcs::RawSample raw = raw_of(camera_, direction, rays_.measure(plan_.scan_id, next_, direction, t_us));
  raw.clock_us = static_cast<std::uint32_t>(t_us);
  ByteWriter out{Bytes(memory.records[next_])};
  out.u32(raw.clock_us);
  write_sample(out, raw, raw.clock_us);
  memory.samples.store(lcs::numbered(command_, ++next_));
}

void MemoryHead::scan_until(TimeUs now_us, lcs::HeadMemory& memory) {
  while (running_) {
    const TimeUs t_us = first_us_ + pattern_time_us(plan_, next_);
    if (t_us > now_us) return;
    measure(t_us, memory);
    running_ = next_ < plan_.points;
  }
}

void MemoryHead::tell_status(TimeUs now_us, lcs::HeadMemory& memory) const {
  lcs::CameraStatus status;
  status.serial = optics_of(camera_).serial();
  status.device = camera_.device;
  status.boots = 1;
  status.clock_us = static_cast<std::uint32_t>(now_us);
  status.temperature_degC = camera_.temperature_degC;
  status.laser_lit = lit();
  status.scanning = running_;
  memory.status.store(lcs::encode(lcs::sequence_of(command_), status));
}

// --- head, memory and driver

// The head sees a command when the memory is next looked at, which is before any sample is due.
Status SensorInMemory::start(const ScanPlan& plan, TimeUs t_start_us) {
  const Status status = driver_.start(plan, t_start_us);
  head_.run(t_start_us, memory_);
  return status;
}

SensorPoll SensorInMemory::poll(TimeUs now_us, Span<RangeSample> out) {
  head_.run(now_us, memory_);
  return driver_.poll(now_us, out);
}

}  // namespace lasso::sim
