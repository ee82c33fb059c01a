#include "fsw/sense/acquisition.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso {
namespace {

struct Cause {
  Status reason;
  ScanLoss loss;
};
constexpr Cause kCauses[] = {
    {Status::kMissing, ScanLoss::kInhibited},  {Status::kOverCapacity, ScanLoss::kNoRoom}, {Status::kTimeout, ScanLoss::kSilent},
    {Status::kNoData, ScanLoss::kSilent},      {Status::kBusy, ScanLoss::kBusy},           {Status::kBadValue, ScanLoss::kRefused},
    {Status::kBadOrder, ScanLoss::kRestarted}, {Status::kBadVersion, ScanLoss::kForeign},  {Status::kTruncated, ScanLoss::kStopped},
    {Status::kOffPlan, ScanLoss::kOffPlan},
};

constexpr double kDirectionTolerance = 2e-3;  // of the squared length

bool finite(const RangeSample& sample) {
  bool ok = is_finite(static_cast<double>(sample.range_m)) && is_finite(static_cast<double>(sample.sigma_factor));
  for (const float component : sample.direction) ok = ok && is_finite(static_cast<double>(component));
  return ok;
}

double squared_length(const RangeSample& sample) {
  double sum = 0;
  for (const float component : sample.direction) sum += static_cast<double>(component) * static_cast<double>(component);
  return sum;
}

bool near_unit(const RangeSample& sample) {
  const double excess = squared_length(sample) - 1;
  return excess >= -kDirectionTolerance && excess <= kDirectionTolerance;
}

// Unit length to float accuracy without a square root: the series of 1/sqrt(1 + e), good to 5e-12 for |e| <= 2e-3.
void make_unit(RangeSample& sample) {
  const double e = squared_length(sample) - 1;
  const double scale = 1 - e * (0.5 - e * (0.375 - 0.3125 * e));
  for (float& component : sample.direction) component = static_cast<float>(static_cast<double>(component) * scale);
}

RangeSample invalid_sample(TimeUs t_us) {
  RangeSample sample;
  sample.t_us = t_us;
  return sample;
}

RangeSample cleaned(const RangeSample& sample) {
  if (sample.state == RayState::kInvalid) return invalid_sample(sample.t_us);
  RangeSample kept = sample;
  make_unit(kept);
  if (kept.state != RayState::kMiss) return kept;
  kept.range_m = 0;
  kept.sigma_factor = 1;
  return kept;
}

bool range_valid(const RangeSample& sample) {
  const bool factor = sample.sigma_factor >= 1 && static_cast<double>(sample.sigma_factor) <= kMaxSigmaFactor;
  return sample.state != RayState::kHit || (factor && sample.range_m >= 0 && static_cast<double>(sample.range_m) <= kMaxRangeM);
}

}  // namespace

bool is_known(RayState state) { return state == RayState::kHit || state == RayState::kMiss || state == RayState::kInvalid; }

bool is_sound(const RangeSample& sample, BadSample& reason) {
  reason = BadSample::kNotFinite;
  if (!finite(sample)) return false;
  reason = BadSample::kDirection;
  if (!near_unit(sample)) return false;
  reason = BadSample::kRange;
  return range_valid(sample);
}

ScanLoss loss_of(Status reason) {
  for (const Cause& cause : kCauses) {
    if (cause.reason == reason) return cause.loss;
  }
  return ScanLoss::kOther;
}

Status Acquisition::start(Sensor& sensor, const ScanPlan& plan, TimeUs t_start_us, RangeImage& image) {
  if (state_ != State::kIdle) return Status::kBusy;
  verdict_ = ScanVerdict{};
  verdict_.scan_id = plan.scan_id;
  image.scan_id = plan.scan_id;
  image.misses_known = true;
  image.aimed_first = first_aimed(plan);
  image.aimed_count = static_cast<std::uint16_t>(plan.aimed.size());
  image.samples.clear();
  well_formed_ = 0;
  t_start_us_ = t_start_us;
  last_t_us_ = t_start_us;
  const Status plan_status = validate(plan);
  verdict_.reason = plan_status == Status::kOk ? sensor.start(plan, t_start_us) : plan_status;
  if (verdict_.reason != Status::kOk) {
    verdict_.loss = loss_of(verdict_.reason);
    return verdict_.reason;
  }
  points_ = sensor.samples_of(plan);
  state_ = State::kRunning;
  return Status::kOk;
}

void Acquisition::step(Sensor& sensor, TimeUs now_us, RangeImage& image) {
  if (state_ != State::kRunning) return;
  const SensorPoll poll = sensor.poll(now_us, Span<RangeSample>(polled_));
  if (poll.status != Status::kOk) return lose(sensor, poll.status);
  if (poll.count > kMaxSamplesPerPoll) return lose(sensor, Status::kBadLength);
  for (std::size_t i = 0; i < poll.count; ++i) {
    const RangeSample sample = polled_[i];  // the compiler may keep it in registers, whatever is written meanwhile
    take(sample, now_us, image);
  }
  if (poll.complete) state_ = State::kComplete;
}

void Acquisition::lose(Sensor& sensor, Status reason) {
  sensor.abort();
  verdict_.reason = reason;
  verdict_.loss = loss_of(reason);
  state_ = State::kLost;
}

bool Acquisition::check(const RangeSample& sample, TimeUs now_us, BadSample& reason) const {
  reason = BadSample::kState;
  if (!is_known(sample.state)) return false;
  reason = BadSample::kTime;
  if (sample.t_us < last_t_us_ || sample.t_us > now_us) return false;
  if (sample.t_us - t_start_us_ > kLongestScan_us) return false;
  if (sample.state == RayState::kInvalid) return true;  // makes no statement that could be wrong
  return is_sound(sample, reason);
}

void Acquisition::take(const RangeSample& sample, TimeUs now_us, RangeImage& image) {
  if (sample.state == RayState::kLost) {
    ++verdict_.lost;
    store(invalid_sample(last_t_us_), image);
    return;
  }
  BadSample reason{};
  if (!check(sample, now_us, reason)) {
    ++verdict_.bad[static_cast<std::size_t>(reason)];
    // A bad sample's time is not believed either: an early one would spoil the order, a late one its successors.
    store(invalid_sample(last_t_us_), image);
    return;
  }
  last_t_us_ = sample.t_us;
  if (store(cleaned(sample), image)) ++well_formed_;
}

bool Acquisition::store(const RangeSample& sample, RangeImage& image) {
  if (!image.samples.push_back(sample)) {
    ++verdict_.overflow;
    return false;
  }
  ++verdict_.count;
  if (sample.state == RayState::kHit) ++verdict_.hits;
  if (sample.state == RayState::kMiss) ++verdict_.misses;
  if (sample.state == RayState::kInvalid) ++verdict_.invalid;
  return true;
}

void Acquisition::judge() {
  const bool enough = well_formed_ * 100 >= points_ * kUsablePercent;
  verdict_.complete = state_ == State::kComplete;
  verdict_.usable = enough && state_ != State::kLost;
  if (state_ == State::kRunning) verdict_.reason = Status::kTimeout;
  if (state_ == State::kComplete && !enough) verdict_.reason = Status::kBadValue;
  if (!enough && state_ == State::kRunning) verdict_.loss = ScanLoss::kUnfinished;
  if (!enough && state_ == State::kComplete) verdict_.loss = ScanLoss::kThin;
}

ScanVerdict Acquisition::finish(Sensor& sensor, RangeImage& image) {
  if (state_ == State::kRunning) sensor.abort();
  if (state_ != State::kIdle) judge();
  if (!verdict_.usable) image.samples.clear();
  const ScanVerdict verdict = verdict_;
  verdict_ = ScanVerdict{};
  state_ = State::kIdle;
  return verdict;
}

}  // namespace lasso
