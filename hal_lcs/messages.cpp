#include "hal_lcs/messages.hpp"

#include "fsw/core/invariant.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "hal_lcs/sample_codec.hpp"

namespace lasso::lcs {
namespace {

constexpr double kSteps = 8388608;          // 2^23 a radian, or a half width
constexpr double kPhaseSteps = 4294967296;  // 2^32 a turn: what is below one turn stays below it
constexpr std::int32_t kEnd24 = 1 << 23;
constexpr std::size_t kSamplesHead = 7;
constexpr std::size_t kAimHead = 2;
constexpr std::size_t kAimedBytes = 8;
constexpr std::size_t kStartBytes = 41;
constexpr std::size_t kAnswerBytes = 7;
constexpr std::size_t kStatusBytes = 18;
constexpr std::size_t kEndBytes = 4;
constexpr std::uint8_t kLaserLit = 1, kScanning = 2;

class Writer {
 public:
  ByteWriter& to() { return out_; }
  FrameBytes frame(std::uint8_t sequence, Type type) const {
    invariant(out_.ok(), "lcs message");
    return encode_frame(static_cast<std::uint8_t>(type), sequence, out_.written());
  }

 private:
  std::uint8_t bytes_[kMaxPayload] = {};
  ByteWriter out_{Bytes(bytes_)};
};

// A real number in steps, rounded to the nearest and kept within [-end, end).
std::int32_t steps(double value, double steps_per_unit, std::int32_t end) {
  const double scaled = value * steps_per_unit;
  if (!(scaled > -end)) return -end;
  if (!(scaled < end - 1)) return end - 1;
  return static_cast<std::int32_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

void put24(ByteWriter& out, std::uint32_t value) {
  out.u8(static_cast<std::uint8_t>(value >> 16));
  out.u16(static_cast<std::uint16_t>(value & 0xFFFFU));
}

std::uint32_t get24(ByteReader& in) {
  const std::uint32_t high = in.u8();
  return (high << 16) | in.u16();
}

// Two's complement of 24 bits.
std::int32_t signed24(std::uint32_t value) {
  constexpr std::uint32_t kSign = 1U << 23;
  return static_cast<std::int32_t>(value ^ kSign) - static_cast<std::int32_t>(kSign);
}

void put_fraction(ByteWriter& out, double fraction) { put24(out, static_cast<std::uint32_t>(steps(fraction, kSteps, kEnd24)) & 0xFFFFFFU); }
double get_fraction(ByteReader& in) { return signed24(get24(in)) / kSteps; }

// The field after the angles: an echo's time, or where the spot is.
void put_measured(ByteWriter& out, const RawSample& sample) {
  if (sample.kind != SampleKind::kEcho) return put_fraction(out, sample.peak);
  put24(out, static_cast<std::uint32_t>(clamp(sample.flight_us, 0, kMaxFlightUs) / kFlightStepUs + 0.5));
}

void get_measured(std::uint32_t word, RawSample& sample) {
  sample.peak = sample.flight_us = 0;
  if (sample.kind == SampleKind::kEcho) sample.flight_us = word * kFlightStepUs;
  if (sample.kind != SampleKind::kEcho) sample.peak = signed24(word) / kSteps;
}

void put_phase(ByteWriter& out, double turns) { out.u32(static_cast<std::uint32_t>(clamp(turns, 0, 1 - 1 / kPhaseSteps) * kPhaseSteps)); }

// Whether `items` of one size after a head make up the payload: how many, 0 if they do not.
std::size_t items_of(const Frame& frame, std::size_t head, std::size_t size) {
  if (frame.length < head || (frame.length - head) % size != 0) return 0;
  return (frame.length - head) / size;
}
static_assert((kMaxPayload - kSamplesHead) / kSampleBytes == kSamplesPerFrame, "a frame holds no more than a message");
static_assert((kMaxPayload - kAimHead) / kAimedBytes == kAimedPerFrame, "a frame holds no more than a message");

}  // namespace

void write_sample(ByteWriter& out, const RawSample& sample, std::uint32_t base_us) {
  const std::uint32_t offset_us = sample.clock_us - base_us;
  invariant(offset_us <= kMaxSampleOffsetUs, "lcs sample time");
  out.u16(static_cast<std::uint16_t>(offset_us));
  put_fraction(out, sample.angle_x_rad);
  put_fraction(out, sample.angle_y_rad);
  put_measured(out, sample);
  out.u8(static_cast<std::uint8_t>((static_cast<unsigned>(sample.kind) << 4) | (sample.intensity & kMaxIntensity)));
}

Status read_sample(ByteReader& in, std::uint32_t base_us, RawSample& sample) {
  sample.clock_us = base_us + in.u16();
  sample.angle_x_rad = get_fraction(in);
  sample.angle_y_rad = get_fraction(in);
  const std::uint32_t measured = get24(in);
  const std::uint8_t last = in.u8();
  sample.intensity = last & kMaxIntensity;
  const unsigned kind = last >> 4;
  if (kind > static_cast<unsigned>(SampleKind::kEcho)) return Status::kBadValue;
  sample.kind = static_cast<SampleKind>(kind);
  get_measured(measured, sample);
  return Status::kOk;
}

StartCommand start_command(const ScanPlan& plan) {
  StartCommand command;
  command.aimed = static_cast<std::uint16_t>(plan.aimed.size());
  command.plan = plan;
  return command;
}

FrameBytes encode(std::uint8_t sequence, Type without_payload) { return Writer().frame(sequence, without_payload); }

FrameBytes encode(std::uint8_t sequence, LaserCommand message) {
  Writer writer;
  writer.to().u8(static_cast<std::uint8_t>(message));
  return writer.frame(sequence, Type::kLaser);
}

FrameBytes encode(std::uint8_t sequence, const AimCommand& message) {
  invariant(message.count <= kAimedPerFrame, "lcs aimed rays");
  Writer writer;
  writer.to().u16(message.first);
  for (std::size_t i = 0; i < message.count; ++i) {
    writer.to().f32(message.rays[i].x);
    writer.to().f32(message.rays[i].y);
  }
  return writer.frame(sequence, Type::kAim);
}

FrameBytes encode(std::uint8_t sequence, const StartCommand& message) {
  Writer writer;
  ByteWriter& out = writer.to();
  const ScanPlan& plan = message.plan;
  out.u32(plan.scan_id);
  out.u8(static_cast<std::uint8_t>(plan.kind));
  out.u16(plan.points);
  out.u16(plan.cycles_a);
  out.u16(plan.cycles_b);
  put_phase(out, plan.phase_turns);
  for (const double real : {plan.center_x, plan.center_y, plan.half_x, plan.half_y}) out.f32(static_cast<float>(real));
  out.u32(static_cast<std::uint32_t>(plan.duration_us));
  out.u32(message.delay_us);
  out.u16(message.aimed);
  return writer.frame(sequence, Type::kStart);
}

FrameBytes encode(std::uint8_t sequence, const Answer& message) {
  Writer writer;
  writer.to().u8(static_cast<std::uint8_t>(message.to));
  writer.to().u8(message.sequence);
  writer.to().u8(static_cast<std::uint8_t>(message.result));
  writer.to().u32(message.clock_us);
  return writer.frame(sequence, Type::kAnswer);
}

FrameBytes encode(std::uint8_t sequence, const CameraStatus& message) {
  Writer writer;
  ByteWriter& out = writer.to();
  out.u32(message.serial);
  out.u32(message.boots);
  out.u32(message.clock_us);
  out.i16(static_cast<std::int16_t>(steps(static_cast<double>(message.temperature_degC), 100, 1 << 15)));
  out.u8(static_cast<std::uint8_t>((message.laser_lit ? kLaserLit : 0U) | (message.scanning ? kScanning : 0U)));
  out.u8(message.faults);
  out.u8(message.version);
  out.u8(static_cast<std::uint8_t>(message.device));
  return writer.frame(sequence, Type::kStatus);
}

FrameBytes encode(std::uint8_t sequence, const Samples& message) {
  invariant(message.count > 0 && message.count <= kSamplesPerFrame, "lcs samples");
  Writer writer;
  const std::uint32_t base_us = message.samples[0].clock_us;
  writer.to().u8(message.tag);
  writer.to().u16(message.first);
  writer.to().u32(base_us);
  for (std::size_t i = 0; i < message.count; ++i) write_sample(writer.to(), message.samples[i], base_us);
  return writer.frame(sequence, Type::kSamples);
}

FrameBytes encode(std::uint8_t sequence, const ScanEnd& message) {
  Writer writer;
  writer.to().u8(message.tag);
  writer.to().u16(message.points);
  writer.to().u8(message.whole ? 1 : 0);
  return writer.frame(sequence, Type::kScanEnd);
}

Status decode(const Frame& frame, LaserCommand& message) {
  if (frame.length != 1) return Status::kBadLength;
  message = static_cast<LaserCommand>(frame.payload[0]);
  switch (message) {
    case LaserCommand::kInhibit:
    case LaserCommand::kArm:
    case LaserCommand::kFire:
      return Status::kOk;
  }
  return Status::kBadValue;
}

Status decode(const Frame& frame, AimCommand& message) {
  message.count = items_of(frame, kAimHead, kAimedBytes);
  if (message.count == 0) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.first = in.u16();
  for (std::size_t i = 0; i < message.count; ++i) {
    message.rays[i].x = in.f32();
    message.rays[i].y = in.f32();
  }
  return Status::kOk;
}

Status decode(const Frame& frame, StartCommand& message) {
  if (frame.length != kStartBytes) return Status::kBadLength;
  ByteReader in(frame.bytes());
  ScanPlan& plan = message.plan;
  plan = ScanPlan{};
  plan.scan_id = in.u32();
  plan.kind = static_cast<PatternKind>(in.u8());
  plan.points = in.u16();
  plan.cycles_a = in.u16();
  plan.cycles_b = in.u16();
  plan.phase_turns = in.u32() / kPhaseSteps;
  for (double* const real : {&plan.center_x, &plan.center_y, &plan.half_x, &plan.half_y}) *real = static_cast<double>(in.f32());
  plan.duration_us = in.u32();
  message.delay_us = in.u32();
  message.aimed = in.u16();
  return Status::kOk;
}

Status decode(const Frame& frame, Answer& message) {
  if (frame.length != kAnswerBytes) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.to = static_cast<Type>(in.u8());  // NOLINT(clang-analyzer-optin.core.EnumCastOutOfRange): what is no type matches none
  message.sequence = in.u8();
  const std::uint8_t result = in.u8();
  message.clock_us = in.u32();
  if (result > static_cast<std::uint8_t>(Result::kFault)) return Status::kBadValue;
  message.result = static_cast<Result>(result);
  return Status::kOk;
}

Status decode(const Frame& frame, CameraStatus& message) {
  if (frame.length != kStatusBytes) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.serial = in.u32();
  message.boots = in.u32();
  message.clock_us = in.u32();
  message.temperature_degC = static_cast<float>(in.i16()) / 100;
  const std::uint8_t state = in.u8();
  message.laser_lit = (state & kLaserLit) != 0;
  message.scanning = (state & kScanning) != 0;
  message.faults = in.u8();
  message.version = in.u8();
  const std::uint8_t device = in.u8();
  const bool known = device <= static_cast<std::uint8_t>(Device::kTridar);
  message.device = known ? static_cast<Device>(device) : Device::kUnknown;
  return Status::kOk;
}

Status decode(const Frame& frame, Samples& message) {
  message.count = items_of(frame, kSamplesHead, kSampleBytes);
  if (message.count == 0) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.tag = in.u8();
  message.first = in.u16();
  const std::uint32_t base_us = in.u32();
  Status status = Status::kOk;
  for (std::size_t i = 0; i < message.count; ++i) {
    const Status one = read_sample(in, base_us, message.samples[i]);
    if (one != Status::kOk) status = one;
  }
  return status;
}

Status decode(const Frame& frame, ScanEnd& message) {
  if (frame.length != kEndBytes) return Status::kBadLength;
  ByteReader in(frame.bytes());
  message.tag = in.u8();
  message.points = in.u16();
  const std::uint8_t whole = in.u8();
  if (whole > 1) return Status::kBadValue;
  message.whole = whole == 1;
  return Status::kOk;
}

}  // namespace lasso::lcs
