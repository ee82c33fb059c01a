// Faults on purpose, linked to the board's flight image for the tests of its answers to them: one in each start, after two frames, one kind
// after the other.
#include <cstdint>

#include "bsp/bare/fault.hpp"
#include "fsw/core/invariant.hpp"
#include "ft/pil/planted_ops.hpp"

extern "C" {
void board_probe(std::uint32_t slot);
extern const std::uint8_t board_code_begin[];
}

namespace {

constexpr std::uint32_t kSlots = 45;
constexpr std::uint32_t kCommon = 12;  // faults of any board, which come after the board's own
std::uint32_t slots = 0;               // of this start
volatile std::uint32_t sink;

// Deeper than the stack is.
[[gnu::noinline]] std::uint32_t dig(std::uint32_t depth) {
  volatile std::uint32_t frame[256];
  frame[depth % 256] = depth;
  return depth > 1000 ? depth : dig(depth + 1) + frame[depth % 256];
}

[[noreturn]] void hang() {
  for (;;) sink = slots;
}

}  // namespace

void board_probe(std::uint32_t) {
  namespace planted = lasso::planted;
  if (++slots != kSlots) return;
  const std::uint32_t own = planted::own_faults(), done = lasso::bare::fault_record().restarts;
  // The last ones, and the first slot that hangs, are as many in a row as the board takes.
  if (done + lasso::bare::kMaxRestarts <= own + kCommon) lasso::bare::end_row_of_restarts();
  // The first start alone has scans to estimate, and so a task whose rest is missed: the others begin in mode safe.
  if (done == 0) return planted::lead_background_to([] { hang(); });
  if (done <= own) return planted::own_fault(done - 1);
  switch (done - own - 1) {
    case 0:  // null pointer, read
      sink = planted::read_at(8);
      return;
    case 1:  // and written
      return planted::write_at(0);
    case 2:  // stray pointer, write
      return planted::write_at(0x30000000);
    case 3:  // constants are not to be written
      return planted::write_at(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(board_code_begin)));
    case 4:  // no instruction
      return planted::no_instruction();
    case 5:  // an exception that nobody awaits
      return planted::call_system();
    case 6:
      return planted::jump_to(0x20000000);
    case 7:
      sink = dig(0);
      return;
    case 8:
      return planted::lead_background_to([] { sink = dig(0); });
    case 9:
      hang();
    case 10:
      lasso::fail_invariant("planted");
    default:
      hang();
  }
}
