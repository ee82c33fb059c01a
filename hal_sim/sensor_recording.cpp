#include "hal_sim/sensor_recording.hpp"

#include <stdexcept>
#include <string>

#include "fsw/core/byte_codec.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::sim {
namespace {

constexpr std::uint32_t kMagic = 0x33444C52;   // "3DLR"
constexpr TimeUs kLatestUs = TimeUs{1} << 61;  // before and after 0: sums and differences of such times stay times
constexpr std::size_t kHeadBytes = 8, kScanBytes = 73, kAimedBytes = 8, kSampleBytes = 29;

std::size_t bytes_of(const SensorScan& scan) { return kScanBytes + kAimedBytes * scan.aimed.size() + kSampleBytes * scan.samples.size(); }

void put(ByteWriter& out, const RangeSample& sample) {
  for (const float component : sample.direction) out.f32(component);
  out.f32(sample.range_m);
  out.i64(sample.t_us);
  out.u8(static_cast<std::uint8_t>(sample.state));
  out.f32(sample.sigma_factor);
}

void put(ByteWriter& out, const SensorScan& scan) {
  const ScanPlan& plan = scan.plan;
  out.u8(scan.sensor);
  out.u32(plan.scan_id);
  out.u8(static_cast<std::uint8_t>(plan.kind));
  for (const std::uint16_t number : {plan.points, plan.cycles_a, plan.cycles_b}) out.u16(number);
  for (const double real : {plan.phase_turns, plan.center_x, plan.center_y, plan.half_x, plan.half_y}) out.f64(real);
  out.i64(plan.duration_us);
  out.u16(static_cast<std::uint16_t>(scan.aimed.size()));
  for (const AimedRay& ray : scan.aimed) {
    out.f32(ray.x);
    out.f32(ray.y);
  }
  out.i64(scan.t_start_us);
  out.u8(static_cast<std::uint8_t>(scan.end));
  out.u16(static_cast<std::uint16_t>(scan.samples.size()));
  for (const RangeSample& sample : scan.samples) put(out, sample);
}

// Reads a recording, and knows where it is for who has to be told.
class Reader {
 public:
  explicit Reader(ConstBytes bytes) : in_(bytes) {}

  SensorRecording read() {
    if (in_.u32() != kMagic) wrong("not what a sensor gave");
    const std::uint32_t version = in_.u32();
    if (version != kRecordingVersion)
      wrong("version " + std::to_string(version) + ", expected " + std::to_string(kRecordingVersion) + ": record it again");
    SensorRecording recording;
    while (in_.remaining() > 0) {
      recording.push_back(scan());
      ++scans_;
    }
    return recording;
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    throw std::invalid_argument("scan " + std::to_string(scans_) + ", byte " + std::to_string(in_.position()) + ": " + what);
  }
  void expect(bool right, const std::string& what) const {
    if (!in_.ok()) wrong("the file ends in the middle of a scan");
    if (!right) wrong(what);
  }

  ScanPlan plan() {
    ScanPlan plan;
    plan.scan_id = in_.u32();
    plan.kind = static_cast<PatternKind>(in_.u8());
    for (std::uint16_t* const number : {&plan.points, &plan.cycles_a, &plan.cycles_b}) *number = in_.u16();
    for (double* const real : {&plan.phase_turns, &plan.center_x, &plan.center_y, &plan.half_x, &plan.half_y}) *real = in_.f64();
    plan.duration_us = in_.i64();
    return plan;
  }

  // Of `scan`, after those that it has.
  RangeSample sample(const SensorScan& scan) {
    RangeSample sample;
    bool finite = true;
    for (float& component : sample.direction) component = in_.f32();
    sample.range_m = in_.f32();
    for (const float component : sample.direction) finite = finite && is_finite(static_cast<double>(component));
    expect(finite && is_finite(static_cast<double>(sample.range_m)), "a sample's direction or range is not finite");
    sample.t_us = in_.i64();
    const TimeUs first_us = scan.samples.empty() ? scan.t_start_us - kRecordingToleranceUs : scan.samples.back().t_us;
    const TimeUs last_us = scan.t_start_us + scan.plan.duration_us + kRecordingToleranceUs;
    expect(sample.t_us >= first_us && sample.t_us <= last_us, "a sample's time is " + std::to_string(sample.t_us) + ", expected " +
                                                                  std::to_string(first_us) + " to " + std::to_string(last_us) +
                                                                  " us: not before its predecessor, and within the scan");
    const std::uint8_t state = in_.u8();
    expect(state <= static_cast<std::uint8_t>(RayState::kLost), "a sample's state is " + std::to_string(state) + ", expected 0 to 3");
    sample.state = static_cast<RayState>(state);
    sample.sigma_factor = in_.f32();
    expect(sample.sigma_factor >= 1 && sample.sigma_factor <= static_cast<float>(kMaxSigmaFactor),
           "a sample's sigma factor is " + std::to_string(sample.sigma_factor) + ", expected 1 to 10");
    return sample;
  }

  SensorScan scan() {
    SensorScan scan;
    scan.sensor = in_.u8();
    expect(scan.sensor < kMaxSensors, "sensor " + std::to_string(scan.sensor) + ", expected less than " + std::to_string(kMaxSensors));
    scan.plan = plan();
    const std::uint16_t aimed = in_.u16();
    expect(aimed <= kMaxAimedRays, std::to_string(aimed) + " aimed rays, expected at most " + std::to_string(kMaxAimedRays));
    scan.aimed.resize(aimed);
    for (AimedRay& ray : scan.aimed) {
      ray.x = in_.f32();
      ray.y = in_.f32();
    }
    ScanPlan whole = scan.plan;
    whole.aimed = Span<const AimedRay>(scan.aimed.data(), scan.aimed.size());
    expect(validate(whole) == Status::kOk, std::string("a plan that no scan can have: ") + to_string(validate(whole)));
    scan.t_start_us = in_.i64();
    expect(scan.t_start_us >= -kLatestUs && scan.t_start_us <= kLatestUs,
           "a start at " + std::to_string(scan.t_start_us) + " us, expected a time less than 2^61 us from 0");
    const std::uint8_t end = in_.u8();
    constexpr auto kLast = static_cast<unsigned>(Status::kOffPlan);
    expect(end <= kLast, "a scan's end is " + std::to_string(end) + ", expected 0 to " + std::to_string(kLast));
    scan.end = static_cast<Status>(end);
    const std::uint16_t samples = in_.u16();
    expect(samples <= scan.plan.points,
           std::to_string(samples) + " samples, expected at most the plan's " + std::to_string(scan.plan.points));
    for (std::uint16_t i = 0; i < samples; ++i) scan.samples.push_back(sample(scan));
    return scan;
  }

  ByteReader in_;
  std::size_t scans_ = 0;
};

}  // namespace

std::vector<std::uint8_t> to_bytes(const SensorRecording& recording) {
  std::size_t size = kHeadBytes;
  for (const SensorScan& scan : recording) size += bytes_of(scan);
  std::vector<std::uint8_t> bytes(size);
  ByteWriter out{Bytes(bytes.data(), bytes.size())};
  out.u32(kMagic);
  out.u32(kRecordingVersion);
  for (const SensorScan& scan : recording) put(out, scan);
  return bytes;
}

SensorRecording recording_of(ConstBytes bytes) { return Reader(bytes).read(); }

}  // namespace lasso::sim
