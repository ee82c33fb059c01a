// A run at the clock's pace, for who watches it.
#pragma once

#include <chrono>

#include "mdat/run/run_listener.hpp"

namespace lasso::mdat {

// Passes on what it hears, and holds each boundary back until its time: `pace` seconds of the run in one of the clock; 0: at once. A run
// that is slower than that is not held back, and the time that it lost is not made up. The run's results do not depend on it.
class PacedListener final : public RunListener {
 public:
  PacedListener(RunListener& next, double pace) : next_(next), pace_(pace) {}
  void on_packets(TimeUs boundary_us, ConstBytes packets) override;
  void on_frame(const FlownFrame& frame) override { next_.on_frame(frame); }
  void on_commands(TimeUs slot_us, ConstBytes bytes) override { next_.on_commands(slot_us, bytes); }

 private:
  using Clock = std::chrono::steady_clock;
  RunListener& next_;
  double pace_;
  TimeUs last_us_ = 0;
  Clock::time_point due_{};  // of the boundary at last_us_; none yet: its epoch
};

}  // namespace lasso::mdat
