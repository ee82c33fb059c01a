#include "bsp/posix/runner.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace lasso::posix {
namespace {

constexpr std::int64_t kNsPerSecond = 1000000000;
constexpr std::int64_t kNsPerUs = 1000;
constexpr std::int64_t kMakeUpLag_ns = 20000000;  // a lag that a paced run makes up for; more of it stretches its time

std::int64_t clock_ns(clockid_t clock) {
  timespec t{};
  (void)clock_gettime(clock, &t);  // fails for clocks only that do not exist
  const std::int64_t seconds = t.tv_sec;
  return seconds * kNsPerSecond + t.tv_nsec;
}

// An absolute sleep on CLOCK_MONOTONIC, which is what steady_clock is here.
void sleep_until(std::int64_t monotonic_ns) {
  std::this_thread::sleep_until(std::chrono::steady_clock::time_point(std::chrono::nanoseconds(monotonic_ns)));
}

}  // namespace

Runner::Runner(Component& component, Pace pace) : component_(component), pace_(pace) {
  if (pace_ == Pace::kRealTime) urgency_.emplace(UrgencyLevel::kSlots);
  if (pace_ != Pace::kAlone) worker_ = std::thread(&Runner::work, this);
}

Runner::~Runner() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

FrameRecord Runner::run_frame() {
  if (pace_ != Pace::kRealTime) wait_for_worker();
  FrameRecord record;
  record.frame = frame_;
  record.boundary_us = component_.next_slot_us();
  const Measurement measured = take_measurement();
  do {
    run_slot();
  } while (!component_.next_slot_is_boundary());
  record.telemetry = ConstBytes(telemetry_, component_.take_telemetry(Bytes(telemetry_)));
  send(record.telemetry);
  record.reset_due = component_.reset_due();
  record.estimated = measured.ran;
  record.estimate_cpu_ns = measured.cpu_ns;
  record.estimate_wall_ns = measured.wall_ns;
  ++frame_;
  return record;
}

void Runner::connect(ByteLink& link) {
  link_ = &link;
  pump_.emplace(component_, link);
}

// What the link does not take is lost: a ground station that does not keep up must not stop the run.
void Runner::send(ConstBytes telemetry) {
  while (link_ != nullptr && !telemetry.empty()) {
    const std::size_t size = packet_size(telemetry);
    static_cast<void>(link_->write(telemetry.first(size)));
    telemetry = telemetry.subspan(size, telemetry.size() - size);
  }
}

void Runner::run_slot() {
  const TimeUs now_us = wait_until(component_.next_slot_us());
  if (pump_) pump_->receive(now_us);
  component_.run_slot(now_us);
  if (!component_.estimation_pending()) return;
  if (pace_ == Pace::kAlone) {
    measurement_ = estimate();
  } else {
    request_estimate();
  }
}

void Runner::request_estimate() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requested_ = true;
  }
  changed_.notify_all();
}

TimeUs Runner::wait_until(TimeUs slot_us) {
  if (pace_ == Pace::kLockstep || pace_ == Pace::kAlone) return slot_us;
  if (!clock_set_) {
    clock_offset_ns_ = clock_ns(CLOCK_MONOTONIC) - slot_us * kNsPerUs;
    clock_set_ = true;
  }
  sleep_until(slot_us * kNsPerUs + clock_offset_ns_);
  const std::int64_t lag_ns = clock_ns(CLOCK_MONOTONIC) - clock_offset_ns_ - slot_us * kNsPerUs;
  if (pace_ == Pace::kRealTime) return slot_us + std::max(lag_ns, std::int64_t{0}) / kNsPerUs;
  clock_offset_ns_ += std::max(lag_ns - kMakeUpLag_ns, std::int64_t{0});
  return slot_us;
}

void Runner::wait_for_worker() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !requested_ && !working_; });
}

Runner::Measurement Runner::take_measurement() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Measurement measured = measurement_;
  measurement_ = Measurement{};
  return measured;
}

void Runner::work() {
  std::optional<Urgency> urgency;
  if (pace_ == Pace::kRealTime) urgency.emplace(UrgencyLevel::kEstimation);
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return requested_ || ending_; });
    if (!requested_) return;
    requested_ = false;
    working_ = true;
    lock.unlock();
    const Measurement measured = estimate();
    lock.lock();
    measurement_ = measured;
    working_ = false;
    changed_.notify_all();
  }
}

Runner::Measurement Runner::estimate() {
  const std::int64_t wall_ns = clock_ns(CLOCK_MONOTONIC);
  const std::int64_t cpu_ns = clock_ns(CLOCK_THREAD_CPUTIME_ID);
  component_.run_estimation();
  Measurement measured;
  measured.ran = true;
  measured.cpu_ns = clock_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_ns;
  measured.wall_ns = clock_ns(CLOCK_MONOTONIC) - wall_ns;
  return measured;
}

}  // namespace lasso::posix
