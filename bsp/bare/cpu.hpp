// What a processor gives to a bare board: interrupts on and off, rest, a time base, one wake-up call, a cache that is written back. Each
// board defines these functions, but for the last.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso::bare {

// Of the time base: a counter that goes at one rate, never stops and does not come round within a mission.
std::uint64_t time_base();
// An interrupt (board.hpp: serve_wake_up) after so many ticks of the time base, at once for 0, kMostWakeTicks at most, in the place of one
// that was asked for before; one that has already come may still be served.
constexpr std::uint32_t kMostWakeTicks = 0x7FFFFFFF;
void wake_in(std::uint32_t ticks);

// All interrupts that the board uses. The former: whether they were allowed before.
bool forbid_interrupts();
void allow_interrupts();
// To be called with interrupts forbidden: rests until there is one, also one that has come before the call; it has been served, and they
// are allowed, when this returns.
void rest();
// With interrupts forbidden, and nothing to wake up for.
[[noreturn]] void rest_for_ever();

// From the data cache to memory: the line, of this size, that holds the byte. All of them are there when the latter returns.
constexpr std::size_t kCacheLineBytes = 32;
void write_back_line(const std::uint8_t* in_line);
void await_write_back();

// By these, of this room: all that was written, before it returns.
void write_back(ConstBytes written);

// Until the end of the scope.
class NoInterrupts {
 public:
  NoInterrupts() : before_(forbid_interrupts()) {}
  ~NoInterrupts() {
    if (before_) allow_interrupts();
  }
  NoInterrupts(const NoInterrupts&) = delete;
  NoInterrupts& operator=(const NoInterrupts&) = delete;

 private:
  bool before_;
};

// Rests until an interrupt has made it true.
template <class Done>
void rest_until(const Done& done) {
  for (forbid_interrupts(); !done(); forbid_interrupts()) rest();
  allow_interrupts();
}

}  // namespace lasso::bare
