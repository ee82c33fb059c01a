#include "fsw/exec/scan_faults.hpp"

#include <cstddef>

#include "fsw/core/crc.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso {
namespace {

class Extent {
 public:
  void take(float tangent) {
    if (tangent < low_) low_ = tangent;
    if (tangent > high_) high_ = tangent;
  }
  double half() const { return 0.5 * (static_cast<double>(high_) - static_cast<double>(low_)); }

 private:
  float low_ = 1e9F;
  float high_ = -1e9F;
};

std::uint32_t bad_samples(const ScanVerdict& verdict) {
  std::uint32_t bad = 0;
  for (const std::uint32_t count : verdict.bad) bad += count;
  return bad;
}

constexpr std::uint32_t bit(ScanLoss loss) { return 1u << static_cast<unsigned>(loss); }
constexpr std::uint32_t kWrongBytes = bit(ScanLoss::kForeign) | bit(ScanLoss::kOffPlan) | bit(ScanLoss::kOther) | bit(ScanLoss::kFrozen);
constexpr std::uint32_t kCutShort = bit(ScanLoss::kStopped) | bit(ScanLoss::kRestarted) | bit(ScanLoss::kThin);
bool is_one_of(ScanLoss loss, std::uint32_t losses) { return (losses & bit(loss)) != 0; }

constexpr std::size_t kMeasuredBytes = offsetof(RangeSample, t_us);
static_assert(kMeasuredBytes == sizeof(RangeSample::direction) + sizeof(RangeSample::range_m), "direction and range, without gaps");
ConstBytes measured(const RangeSample& sample) { return {reinterpret_cast<const std::uint8_t*>(&sample), kMeasuredBytes}; }

float distance(float a, float b) { return a < b ? b - a : a - b; }
bool apart(const AimedRay& a, const AimedRay& b) { return distance(a.x, b.x) > kTracedOffset || distance(a.y, b.y) > kTracedOffset; }

AimedRay place_of(const Vec3& direction) {
  return {static_cast<float>(direction.x() / direction.z()), static_cast<float>(direction.y() / direction.z())};
}

}  // namespace

bool mirrors_stuck(const ScanPlan& plan, const RangeImage& image) {
  Extent x;
  Extent y;
  std::size_t rays = 0;
  for (const RangeSample& sample : image.samples) {
    if (sample.state == RayState::kInvalid) continue;
    x.take(sample.direction[0] / sample.direction[2]);
    y.take(sample.direction[1] / sample.direction[2]);
    ++rays;
  }
  return rays >= kRaysToTell && (x.half() < kStuckShare * plan.half_x || y.half() < kStuckShare * plan.half_y);
}

ScanTrace trace_of(const ScanPlan& plan, const RangeImage& image) {
  ScanTrace trace;
  for (const RangeSample& sample : image.samples) {
    trace.digest = crc32c(measured(sample), trace.digest);
    if (sample.state != RayState::kInvalid) ++trace.rays;
  }
  for (std::size_t i = 0; i < kTracedRays; ++i) {
    trace.planned[i] = place_of(pattern_direction(plan, static_cast<std::uint16_t>(i * plan.points / kTracedRays)));
  }
  return trace;
}

bool is_repeated(const ScanTrace& before, const ScanTrace& scan) {
  if (scan.rays < kRaysToTell || scan.digest != before.digest) return false;
  for (std::size_t i = 0; i < kTracedRays; ++i) {
    if (apart(scan.planned[i], before.planned[i])) return true;
  }
  return false;
}

FaultSet scan_faults(const ScanVerdict& verdict) {
  using L = ScanLoss;
  const ScanLoss loss = verdict.loss;
  const std::uint32_t bad = bad_samples(verdict);
  const std::uint32_t damaged = verdict.lost + bad;
  const bool came = verdict.count > 0;
  const bool ended_late = !verdict.complete && verdict.reason == Status::kTimeout && came;
  FaultSet faults;
  faults.add(Fault::kSensorSilent, loss == L::kSilent || (loss == L::kUnfinished && !came));
  faults.add(Fault::kSensorLate, loss == L::kBusy || ended_late);
  faults.add(Fault::kSensorCorrupt, is_one_of(loss, kWrongBytes) || damaged > kDamagedShare * verdict.count);
  faults.add(Fault::kSensorStuck, loss == L::kStuck);
  // What was lost on the way need not be among the invalid: nothing is subtracted that could be less than nothing.
  faults.add(Fault::kSensorSaturated, 2U * verdict.invalid > verdict.count + 2 * damaged);
  faults.add(Fault::kScanIncomplete, is_one_of(loss, kCutShort) || (loss == L::kUnfinished && came));
  return faults;
}

}  // namespace lasso
