// Faults on purpose, linked to the board's flight image for the tests of its answers to them: one in each start, after two frames, one kind
// after the other.
#include <cstdint>

#include "bsp/ppc603e/fault.hpp"
#include "fsw/core/invariant.hpp"

extern "C" void board_probe(std::uint32_t slot);

namespace {

constexpr std::uint32_t kSlots = 45;
std::uint32_t slots = 0;  // of this start
volatile std::uint32_t sink;

// By their instructions: a compiler may leave out what cannot be right.
void read_at(std::uint32_t address) {
  std::uint32_t word = 0;
  __asm__ volatile("lwz %0,0(%1)" : "=r"(word) : "b"(address) : "memory");
  sink = word;
}
void write_at(std::uint32_t address) { __asm__ volatile("stw %0,0(%0)" ::"b"(address) : "memory"); }
void jump_to(std::uint32_t address) { __asm__ volatile("mtctr %0\n\tbctr" ::"r"(address) : "ctr", "memory"); }

// Deeper than the stack is.
[[gnu::noinline]] std::uint32_t dig(std::uint32_t depth) {
  volatile std::uint32_t frame[256];
  frame[depth % 256] = depth;
  return depth > 1000 ? depth : dig(depth + 1) + frame[depth % 256];
}

}  // namespace

void board_probe(std::uint32_t slot) {
  if (++slots != kSlots) return;
  switch (lasso::ppc603e::fault_record().restarts) {
    case 0:  // null pointer, read
      return read_at(8);
    case 1:  // stray pointer, write
      return write_at(0x30000000);
    case 2:  // constants are not to be written
      return write_at(0x00100000);
    case 3:  // no instruction
      __asm__ volatile(".long 0");
      return;
    case 4:  // an exception that nobody awaits
      __asm__ volatile("sc" ::: "memory");
      return;
    case 5:
      return jump_to(0x20000000);
    case 6:
      sink = dig(0);
      return;
    case 7:
      lasso::on_invariant_failure("planted");
    default:
      for (;;) sink = slot;
  }
}
