// Runs the flight component on Linux: the caller is the acquisition thread, a worker thread estimates (Pace::kAlone: the caller does).
// Estimates are timed here, outside the flight code.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "bsp/posix/urgency.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/component.hpp"
#include "fsw/exec/link_pump.hpp"
#include "fsw/link/byte_link.hpp"

namespace lasso::posix {

enum class Pace : std::uint8_t {
  kLockstep,  // simulated time, as fast as possible; the worker is waited for at each boundary: never an overrun
  kAlone,     // the same without a worker: where other flights fill the other cores, which no worker then waits for
  kPaced,  // the same, but no faster than the clock: for a simulated world with an operator. A late machine stretches time, loses nothing
  kRealTime,  // absolute sleeps, overruns are real: for a world with a clock of its own. Both threads are urgent (Urgency)
};

// What one call of run_frame() saw.
struct FrameRecord {
  std::uint32_t frame = 0;
  TimeUs boundary_us = 0;            // time of its boundary
  ConstBytes telemetry;              // whole packets taken at that boundary, valid until the next call
  bool estimated = false;            // an estimate ran between the previous boundary and this one: the one that `telemetry` reports
  std::int64_t estimate_cpu_ns = 0;  // processor time of that estimate's thread
  std::int64_t estimate_wall_ns = 0;
  bool reset_due = false;  // the component is to be started anew: by whoever made it, with a runner of its own
};

class Runner {
 public:
  // `component` has its image and has begun. By the clock, boundary 0 is the moment of the first run_frame(). All calls, the destructor's,
  // too, are of one thread.
  explicit Runner(Component& component, Pace pace = Pace::kLockstep);
  ~Runner();  // waits for a running estimate
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  // From now on commands come by the link, looked at before each slot, and telemetry goes there, too. It outlives the runner.
  void connect(ByteLink& link);

  // Passes the boundary of the next frame and runs all its slots. Scan k is reported by the call for frame k + 2.
  FrameRecord run_frame();

 private:
  struct Measurement {
    bool ran = false;
    std::int64_t cpu_ns = 0;
    std::int64_t wall_ns = 0;
  };
  void run_slot();
  void request_estimate();
  void work();
  Measurement estimate();
  Measurement take_measurement();
  void wait_for_worker();
  TimeUs wait_until(TimeUs slot_us);

  void send(ConstBytes telemetry);

  Component& component_;
  Pace pace_;
  std::optional<Urgency> urgency_;  // of the caller
  ByteLink* link_ = nullptr;
  std::optional<LinkPump> pump_;
  std::int64_t clock_offset_ns_ = 0;  // monotonic clock at component time 0
  bool clock_set_ = false;
  std::uint32_t frame_ = 0;
  std::uint8_t telemetry_[kTelemetryQueueBytes] = {};

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool requested_ = false;  // an estimate is wanted and not taken up yet
  bool working_ = false;
  bool ending_ = false;
  Measurement measurement_;
  std::thread worker_;  // none in kAlone; last: uses all of the above
};

}  // namespace lasso::posix
