#include "bsp/bare/board.hpp"

#include "bsp/bare/console.hpp"
#include "bsp/bare/fault.hpp"
#include "bsp/cortexa9/devices.hpp"

extern "C" void board_interrupt();

namespace lasso::bare {
namespace {

using cortexa9::kDistributor;
using cortexa9::kInterface;
using cortexa9::read_device;
using cortexa9::write_device;

// The interrupt controller, by its interface to the processor (ICCPMR, ICCIAR, ICCEOIR) and by its distributor (ICDISER, ICDICER, ICDIPR,
// ICDIPTR).
constexpr std::uint32_t kLowestPriority = kInterface + 4, kAcknowledge = kInterface + 12, kEnd = kInterface + 16;
constexpr std::uint32_t kEnable = kDistributor + 0x100, kDisable = kDistributor + 0x180, kPriorities = kDistributor + 0x400,
                        kProcessors = kDistributor + 0x800;
constexpr std::uint32_t kWords = 3, kIds = 96;  // interrupts that it knows, 32 a word
constexpr std::uint32_t kPriority = 0xA0A0A0A0, kFirstProcessor = 0x01010101, kAllPriorities = 0xFF, kIdMask = 0x3FF;
constexpr std::uint32_t kTimerBit = 1u << cortexa9::kTimerInterrupt;
constexpr std::uint32_t kPortBits = 7u << (cortexa9::kFirstPortInterrupt - 32);  // camera, ground, rig

constexpr std::uint32_t kDataAbort = 0x10;
constexpr std::uint32_t kCortexA9 = 0x4100C090, kPartMask = 0xFF00FFF0;      // MIDR: ARM's, part
constexpr std::uint32_t kMotherboard = 0x01900000, kBoardMask = 0x0FFF0000;  // SYS_ID: V2M-P1

std::uint32_t processor() {
  std::uint32_t value = 0;
  __asm__ volatile("mrc p15, 0, %0, c0, c0, 0" : "=r"(value));
  return value;
}

// All masked but the timer's, of one priority: none interrupts another. Nothing is left of a start before.
void open_interrupts() {
  for (std::uint32_t i = 0; i < kWords; ++i) {
    write_device(kDisable + 4 * i, 0xFFFFFFFF);
    write_device(cortexa9::kWithdraw + 4 * i, 0xFFFFFFFF);
  }
  for (std::uint32_t i = 0; i < kIds; i += 4) write_device(kPriorities + i, kPriority);
  for (std::uint32_t i = 32; i < kIds; i += 4) write_device(kProcessors + i, kFirstProcessor);
  write_device(kEnable, kTimerBit);
  write_device(kDistributor, 1);
  write_device(kLowestPriority, kAllPriorities);
  write_device(cortexa9::kInterfaceControl, 1);
}

}  // namespace

[[gnu::section(".board_id"), gnu::used]] const char board_id[32] = "3dlasso board cortexa9-vexpress";
const std::uint32_t nominal_ticks_per_s = 25000000;

// The console first: a refusal is for reading.
void check_board() {
  open_console(port_registers(kConsolePort));
  if ((processor() & kPartMask) != kCortexA9) stop("the image is for another board: the processor is not a Cortex-A9");
  if ((read_device(cortexa9::kSystemId) & kBoardMask) != kMotherboard)
    stop("the image is for another board: no Versatile Express motherboard");
  cortexa9::start_timer();
  open_interrupts();
}

std::uint32_t port_registers(std::uint32_t port) { return cortexa9::kFirstPort + cortexa9::kPortStep * port; }

void unmask_line_interrupts() { write_device(kEnable + 4, kPortBits); }

void mask_line_interrupts() { write_device(kDisable + 4, kPortBits); }

// A section each for good, what was loaded for reading alone (start.S).
void map_devices() {}

void map_loaded() {}

std::uint32_t fault_address(const FaultRegisters& r) { return r.vector == kDataAbort ? r.data_address : r.instruction; }

}  // namespace lasso::bare

// The controller may let the next one through before this one is served: a slot is interrupted by the lines.
void board_interrupt() {
  using namespace lasso;
  const std::uint32_t acknowledged = cortexa9::read_device(bare::kAcknowledge), id = acknowledged & bare::kIdMask;
  if (id >= bare::kIds) return;  // none any more
  if (id == cortexa9::kTimerInterrupt) cortexa9::clear_timer_interrupt();
  cortexa9::write_device(bare::kEnd, acknowledged);
  if (id == cortexa9::kTimerInterrupt) return bare::serve_wake_up();
  return bare::serve_lines();
}
