#include "bsp/bare/clock.hpp"

#include "bsp/bare/cpu.hpp"

namespace lasso::bare {
namespace {

constexpr std::uint64_t kUsPerSecond = 1000000;

}  // namespace

void Clock::set(TimeUs now_us) {
  zero_ = time_base();
  stopped_ = 0;
  offset_us_ = now_us;
}

std::uint64_t Clock::ticks() const { return (stopped_ != 0 ? stopped_ : time_base()) - zero_; }

DurationUs Clock::us_of(std::uint64_t ticks) const {
  return static_cast<DurationUs>(ticks / hz_ * kUsPerSecond + ticks % hz_ * kUsPerSecond / hz_);
}

// Rounded up: at that tick the time has come.
std::uint64_t Clock::ticks_in(DurationUs dt_us) const {
  const auto us = static_cast<std::uint64_t>(dt_us);
  return us / kUsPerSecond * hz_ + (us % kUsPerSecond * hz_ + kUsPerSecond - 1) / kUsPerSecond;
}

std::uint64_t Clock::ticks_at(TimeUs t_us) const { return t_us > offset_us_ ? ticks_in(t_us - offset_us_) : 0; }

void Clock::stop() { stopped_ = time_base(); }

void Clock::go_on() {
  zero_ += time_base() - stopped_;
  stopped_ = 0;
}

std::uint64_t Clock::skip_to(TimeUs t_us) {
  const std::uint64_t then = ticks_at(t_us), now = ticks();
  const std::uint64_t skipped = then > now ? then - now : 0;
  zero_ -= skipped;
  return skipped;
}

void Clock::wake_at(TimeUs t_us) const {
  const std::uint64_t then = ticks_at(t_us), now = ticks();
  const std::uint64_t left = then > now ? then - now : 0;
  wake_in(static_cast<std::uint32_t>(left < kMostWakeTicks ? left : kMostWakeTicks));
}

}  // namespace lasso::bare
