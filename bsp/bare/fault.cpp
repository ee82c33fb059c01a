#include "bsp/bare/fault.hpp"

#include "bsp/bare/board.hpp"
#include "bsp/bare/console.hpp"
#include "bsp/bare/cpu.hpp"
#include "fsw/core/invariant.hpp"

extern "C" {
[[noreturn]] void _start();
[[noreturn]] void board_fault();
// The vectors fill the registers before it has a stack.
lasso::bare::FaultRegisters board_fault_registers;
alignas(16) std::uint8_t board_fault_stack[4096];
extern const std::uint8_t board_fault_stack_end[];
}
__asm__(".globl board_fault_stack_end\n.set board_fault_stack_end, board_fault_stack + 4096");

namespace lasso::bare {
namespace {

constexpr std::uint32_t kMagic = 0x4C46524D;
[[gnu::section(".kept")]] FaultRecord record;

std::uint32_t sum_of(const FaultRecord& of) {
  const auto* byte = reinterpret_cast<const std::uint8_t*>(&of);
  std::uint32_t sum = 1;
  for (std::uint32_t i = 0; i < offsetof(FaultRecord, sum); ++i) sum = sum * 31 + byte[i];
  return sum;
}

[[noreturn]] void stay_down() {
  say("board: too many restarts: stays down until power is switched\n");
  rest_for_ever();
}

void copy_text(const char* text) {
  std::uint32_t i = 0;
  for (; i + 1 < kTextBytes && text[i] != '\0'; ++i) record.text[i] = text[i];
  record.text[i] = '\0';
}

}  // namespace

const FaultRecord& open_record() {
  if (record.magic != kMagic || record.sum != sum_of(record)) record = FaultRecord{};
  record.magic = kMagic;
  record.sum = sum_of(record);
  return record;
}

const FaultRecord& fault_record() { return record; }

void end_row_of_restarts() {
  record.in_a_row = 0;
  record.sum = sum_of(record);
}

void restart(ResetCause cause, const char* text) {
  forbid_interrupts();
  map_devices();  // a start may have failed while it read what was loaded
  open_record();  // what a flipped bit or power-on left in it must not count as restarts
  record.magic = kMagic;
  record.cause = static_cast<std::uint32_t>(cause);
  ++record.restarts;
  if (cause != ResetCause::kCommanded) ++record.in_a_row;
  record.registers = cause == ResetCause::kException ? board_fault_registers : FaultRegisters{};
  copy_text(text);
  record.sum = sum_of(record);
  say("board: ");
  say(text);
  if (cause == ResetCause::kException) {
    say_hex(", vector ", record.registers.vector);
    say_hex(", instruction ", record.registers.instruction);
    say_hex(", address ", fault_address(record.registers));
  }
  const char* const next = cause == ResetCause::kCommanded ? ": restart\n" : ": restart into safe mode\n";
  const bool is_last = cause != ResetCause::kCommanded && record.in_a_row > kMaxRestarts;
  say(is_last ? "\n" : next);
  if (is_last) stay_down();
  _start();
}

}  // namespace lasso::bare

void board_fault() { lasso::bare::restart(lasso::ResetCause::kException, "exception"); }

namespace lasso {
[[noreturn]] void on_invariant_failure(const InvariantFailure& failure) { bare::restart(ResetCause::kInvariant, failure.what); }
}  // namespace lasso
