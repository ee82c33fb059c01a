#include "bsp/ppc603e/cpu.hpp"

#include "bsp/bare/cpu.hpp"

namespace lasso::bare {

using ppc603e::kExternalInterrupts;
using ppc603e::machine_state;
using ppc603e::set_machine_state;

std::uint64_t time_base() {
  std::uint32_t high = 0, low = 0, again = 0;
  do {  // NOLINT(bugprone-infinite-loop): the processor changes them
    __asm__ volatile("mftbu %0\n\tmftb %1\n\tmftbu %2" : "=r"(high), "=r"(low), "=r"(again));
  } while (high != again);
  return (std::uint64_t{high} << 32) | low;
}

void wake_in(std::uint32_t ticks) { __asm__ volatile("mtdec %0" ::"r"(ticks)); }

bool forbid_interrupts() {
  const std::uint32_t before = machine_state();
  set_machine_state(before & ~kExternalInterrupts);
  return (before & kExternalInterrupts) != 0;
}

void allow_interrupts() { set_machine_state(machine_state() | kExternalInterrupts); }

void rest() { set_machine_state(machine_state() | kExternalInterrupts | ppc603e::kRest); }

void rest_for_ever() {
  wake_in(kMostWakeTicks);
  for (;;) set_machine_state(machine_state() | ppc603e::kRest);
}

void write_back_line(const std::uint8_t* in_line) { __asm__ volatile("dcbst 0,%0" ::"r"(in_line) : "memory"); }

void await_write_back() { __asm__ volatile("sync" ::: "memory"); }

}  // namespace lasso::bare
