#include "mdat/run/paced_listener.hpp"

#include <algorithm>
#include <thread>

namespace lasso::mdat {

void PacedListener::on_packets(TimeUs boundary_us, ConstBytes packets) {
  if (pace_ > 0) {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> since_last(due_ == Clock::time_point{} ? 0 : to_seconds(boundary_us - last_us_) / pace_);
    due_ = due_ == Clock::time_point{} ? now : std::max(now, due_ + std::chrono::duration_cast<Clock::duration>(since_last));
    last_us_ = boundary_us;
    std::this_thread::sleep_until(due_);
  }
  next_.on_packets(boundary_us, packets);
}

}  // namespace lasso::mdat
