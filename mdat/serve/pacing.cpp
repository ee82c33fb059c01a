#include "mdat/serve/pacing.hpp"

#include <algorithm>

namespace lasso::mdat::serve {
namespace {

constexpr double kLongestWait_s = 86400;         // a clock's time points do not hold what a pace near 0 asks for
constexpr std::chrono::milliseconds kLate(100);  // by which a boundary that waited may be, to count as passed on time

}  // namespace

void Pacing::change(const std::function<void()>& to) {
  {
    const std::lock_guard lock(mutex_);
    to();
  }
  changed_.notify_all();
}

void Pacing::set_pace(double pace) {
  change([&] { pace_ = pace; });
}

void Pacing::pause() {
  change([&] { paused_ = true; });
}

void Pacing::resume() {
  change([&] {
    paused_ = false;
    steps_ = 0;
  });
}

void Pacing::step() {
  change([&] {
    paused_ = true;
    ++steps_;
  });
}

void Pacing::hurry_to(TimeUs until_us) {
  change([&] { hurried_us_ = until_us; });
}

void Pacing::stop() {
  change([&] { stopped_ = true; });
}

double Pacing::pace() const {
  const std::lock_guard lock(mutex_);
  return pace_;
}

bool Pacing::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

// By the pace as it is now: a change holds for the wait that is under way.
Pacing::Clock::time_point Pacing::due(TimeUs boundary_us) const {
  if (!begun_ || pace_ <= 0) return passed_;
  const std::chrono::duration<double> wait(std::min(to_seconds(boundary_us - last_us_) / pace_, kLongestWait_s));
  return passed_ + std::chrono::duration_cast<Clock::duration>(wait);
}

bool Pacing::pass(TimeUs boundary_us) {
  std::unique_lock lock(mutex_);
  const Clock::time_point arrived = Clock::now();
  while (!stopped_) {
    if (boundary_us <= hurried_us_) break;
    if (paused_ && steps_ > 0) {
      --steps_;
      break;
    }
    if (!paused_ && Clock::now() >= due(boundary_us)) break;
    if (paused_) {
      changed_.wait(lock);
    } else {
      changed_.wait_until(lock, due(boundary_us));
    }
  }
  const Clock::time_point now = Clock::now(), on_time = due(boundary_us);
  const bool kept = on_time >= arrived && on_time <= now && now - on_time < kLate;
  passed_ = kept ? on_time : now;
  last_us_ = boundary_us;
  begun_ = true;
  return !stopped_;
}

}  // namespace lasso::mdat::serve
