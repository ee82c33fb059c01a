// How late the wake-up call comes while the lines are busy. Where a rig stops the clock, no slot's own wake-up call meets their interrupts
// (docs/pil.md); so, while the rig is awaited, each of these asks for one shortly after itself, at another distance each time. Those count
// whose time comes within an interrupt of the lines: where the processor rests, an emulator may take its time.
#pragma once

#include <cstdint>

#include "bsp/bare/cpu.hpp"

namespace lasso::bare {

class LatencyProbe {
 public:
  void begin() { on_ = true; }
  // No more wake-up calls. One that has come already is served as any other.
  void end() {
    on_ = false;
    due_ = 0;
    met_ = false;
  }

  // At the end of a lines' interrupt that has begun then; interrupts are forbidden.
  void ask(std::uint64_t begun) {
    if (!on_) return;
    const std::uint64_t due = due_;
    if (due != 0) {
      if (due + kEntryTicks >= begun && due <= time_base()) met_ = true;
      return;
    }
    number_ = number_ + 1;
    const std::uint32_t distance = kLeastTicks + number_ * kStepTicks % kMostTicks;
    due_ = time_base() + distance;
    wake_in(distance);
  }

  // First of all, of the wake-up call at `now`: whether it was asked for here. Interrupts are forbidden.
  bool answers(std::uint64_t now) {
    if (due_ == 0 || now < due_) return false;
    const auto late = static_cast<std::uint32_t>(now - due_);
    if (met_ && late > worst_) worst_ = late;
    due_ = 0;
    met_ = false;
    return true;
  }

  // Ticks of the time base; 0: none met an interrupt of the lines. Begins anew.
  std::uint32_t take_worst() {
    const std::uint32_t worst = worst_;
    worst_ = 0;
    return worst;
  }

 private:
  static constexpr std::uint32_t kLeastTicks = 32, kStepTicks = 89, kMostTicks = 2048;
  static constexpr std::uint32_t kEntryTicks = 256;  // from an interrupt to its first function, at most
  volatile bool on_ = false, met_ = false;
  volatile std::uint64_t due_ = 0;
  volatile std::uint32_t worst_ = 0, number_ = 0;
};

}  // namespace lasso::bare
