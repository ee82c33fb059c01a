#include "bsp/bare/cpu.hpp"

#include "bsp/cortexa9/devices.hpp"

namespace lasso::cortexa9 {
namespace {

// The global timer. From r2p0 on its comparator holds for a time that has come already; earlier ones would miss it.
constexpr std::uint32_t kLow = kTimer + 0, kHigh = kTimer + 4, kControl = kTimer + 8, kStatus = kTimer + 12, kCompareLow = kTimer + 16,
                        kCompareHigh = kTimer + 20;
constexpr std::uint32_t kCount = 1 | 3 << 8;  // each fourth clock of the processor's devices
constexpr std::uint32_t kCompare = 2 | 4;     // and interrupt

}  // namespace

void start_timer() {
  write_device(kControl, kCount);
  write_device(kStatus, 1);
}

void clear_timer_interrupt() { start_timer(); }

}  // namespace lasso::cortexa9

namespace lasso::bare {

using cortexa9::read_device;
using cortexa9::write_device;

std::uint64_t time_base() {
  std::uint32_t high = 0, low = 0, again = 0;
  do {
    high = read_device(cortexa9::kHigh);
    low = read_device(cortexa9::kLow);
    again = read_device(cortexa9::kHigh);
  } while (high != again);
  return (std::uint64_t{high} << 32) | low;
}

void wake_in(std::uint32_t ticks) {
  cortexa9::start_timer();
  write_device(cortexa9::kWithdraw, 1u << cortexa9::kTimerInterrupt);
  const std::uint64_t then = time_base() + ticks;
  write_device(cortexa9::kCompareLow, static_cast<std::uint32_t>(then));
  write_device(cortexa9::kCompareHigh, static_cast<std::uint32_t>(then >> 32));
  write_device(cortexa9::kControl, cortexa9::kCount | cortexa9::kCompare);
}

bool forbid_interrupts() {
  constexpr std::uint32_t kForbidden = 0x80;  // CPSR.I
  std::uint32_t state = 0;
  __asm__ volatile("mrs %0, cpsr\n\tcpsid i" : "=r"(state)::"memory");
  return (state & kForbidden) == 0;
}

void allow_interrupts() { __asm__ volatile("cpsie i\n\tisb" ::: "memory"); }

// An interrupt ends the rest although it is forbidden, and is served behind it.
void rest() { __asm__ volatile("dsb\n\twfi\n\tcpsie i\n\tisb" ::: "memory"); }

void rest_for_ever() {
  write_device(cortexa9::kInterfaceControl, 0);
  for (;;) __asm__ volatile("dsb\n\twfi" ::: "memory");
}

void write_back_line(const std::uint8_t* in_line) { __asm__ volatile("mcr p15, 0, %0, c7, c10, 1" ::"r"(in_line) : "memory"); }

void await_write_back() { __asm__ volatile("dsb" ::: "memory"); }

}  // namespace lasso::bare
