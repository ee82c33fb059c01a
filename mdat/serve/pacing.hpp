// The pace of a run that is watched: faster, slower, a pause, single frames. The run's results do not depend on it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

#include "mdat/run/run_listener.hpp"

namespace lasso::mdat::serve {

constexpr double kMostPace = 1000;

// Safe for several threads: all but pass() are for whoever watches, pass() is the run's.
class Pacing {
 public:
  // `pace`: seconds of the run in one of the clock, up to kMostPace; 0: as fast as it goes.
  explicit Pacing(double pace) : pace_(pace) {}

  void set_pace(double pace);
  void pause();
  void resume();
  // Pauses, and lets one more boundary pass.
  void step();
  // What comes until then passes at once, paused or not.
  void hurry_to(TimeUs until_us);
  // The run ends at its next boundary, whatever it waits for.
  void stop();
  double pace() const;
  bool paused() const;

  // Waits until the run may go on beyond this boundary. False: it is to end. Time that a slow run lost is not made up.
  bool pass(TimeUs boundary_us);

 private:
  using Clock = std::chrono::steady_clock;
  void change(const std::function<void()>& to);
  Clock::time_point due(TimeUs boundary_us) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  double pace_;
  bool paused_ = false, stopped_ = false, begun_ = false;
  std::uint32_t steps_ = 0;  // that wait to be taken
  TimeUs hurried_us_ = -1;   // until when nothing waits
  TimeUs last_us_ = 0;       // boundary that passed, and when
  Clock::time_point passed_{};
};

}  // namespace lasso::mdat::serve
