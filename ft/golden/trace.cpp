#include "ft/golden/trace.hpp"

namespace lasso::golden {
namespace {

constexpr std::uint32_t kMagic = 0x33444C54;  // "3DLT"
enum Call : std::uint8_t { kStart = 1, kPoll = 2, kAbort = 3 };

void put(ByteWriter& out, const Vec3& v) {
  for (int i = 0; i < 3; ++i) out.f64(v[i]);
}

void get(ByteReader& in, Vec3& v) {
  for (int i = 0; i < 3; ++i) v[i] = in.f64();
}

void put(ByteWriter& out, const RangeSample& sample) {
  for (const float component : sample.direction) out.f32(component);
  out.f32(sample.range_m);
  out.i64(sample.t_us);
  out.u8(static_cast<std::uint8_t>(sample.state));
}

void get(ByteReader& in, RangeSample& sample) {
  for (float& component : sample.direction) component = in.f32();
  sample.range_m = in.f32();
  sample.t_us = in.i64();
  sample.state = static_cast<RayState>(in.u8());
}

}  // namespace

void put(ByteWriter& out, const TraceHeader& header) {
  out.u32(kMagic);
  out.u32(kTraceVersion);
  out.u32(header.frames);
  out.i64(header.boundary_0_us);
  const Quat& q = header.T_sensor_target.q;
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) out.f64(value);
  put(out, header.T_sensor_target.p);
  put(out, header.rates.omega_radps);
  put(out, header.rates.v_mps);
  out.i64(header.t_us);
}

Status get(ByteReader& in, TraceHeader& header) {
  if (in.remaining() < kTraceHeaderBytes) return Status::kTruncated;
  if (in.u32() != kMagic) return Status::kBadMagic;
  if (in.u32() != kTraceVersion) return Status::kBadVersion;
  header.frames = in.u32();
  header.boundary_0_us = in.i64();
  double q[4];
  for (double& value : q) value = in.f64();
  header.T_sensor_target.q = Quat(q[3], q[0], q[1], q[2]);
  get(in, header.T_sensor_target.p);
  get(in, header.rates.omega_radps);
  get(in, header.rates.v_mps);
  header.t_us = in.i64();
  return in.ok() ? Status::kOk : Status::kTruncated;
}

void put_start(ByteWriter& out, const ScanPlan& plan, TimeUs t_start_us) {
  out.u8(kStart);
  out.u32(plan.scan_id);
  out.u8(static_cast<std::uint8_t>(plan.kind));
  out.u16(plan.points);
  out.u16(plan.cycles_a);
  out.u16(plan.cycles_b);
  for (const double value : {plan.phase_turns, plan.center_x, plan.center_y, plan.half_x, plan.half_y}) out.f64(value);
  out.i64(plan.duration_us);
  out.u16(static_cast<std::uint16_t>(plan.aimed.size()));
  for (const AimedRay& ray : plan.aimed) {
    out.f32(ray.x);
    out.f32(ray.y);
  }
  out.i64(t_start_us);
}

void put_poll(ByteWriter& out, TimeUs now_us, std::size_t samples) {
  out.u8(kPoll);
  out.i64(now_us);
  out.u32(static_cast<std::uint32_t>(samples));
}

void put_abort(ByteWriter& out) { out.u8(kAbort); }

void put_answer(ByteWriter& out, const SensorPoll& poll, Span<const RangeSample> samples) {
  out.u8(static_cast<std::uint8_t>(poll.status));
  out.u32(static_cast<std::uint32_t>(poll.count));
  out.u8(poll.complete ? 1 : 0);
  for (const RangeSample& sample : samples) put(out, sample);
}

bool get_answer(ByteReader& in, SensorPoll& poll, Span<RangeSample> out) {
  poll.status = static_cast<Status>(in.u8());
  poll.count = in.u32();
  poll.complete = in.u8() != 0;
  if (poll.count > out.size()) return false;
  for (RangeSample& sample : out.first(poll.count)) get(in, sample);
  return in.ok();
}

}  // namespace lasso::golden
