#include "bsp/bare/board.hpp"

#include "bsp/bare/console.hpp"
#include "bsp/bare/fault.hpp"
#include "bsp/ppc603e/board_bus.hpp"
#include "bsp/ppc603e/cpu.hpp"

extern "C" void board_interrupt(std::uint32_t vector);

namespace lasso::bare {
namespace {

// As start.S has them: 0xFC000000, 64 MB, read and write, not cached, guarded.
constexpr std::uint32_t kDevices = 0xFC0007FE, kDevicesHow = 0xFC00002A;
// 0x04000000, 32 MB, read only: link.ld's LOADED.
constexpr std::uint32_t kLoaded = 0x040003FE, kLoadedHow = 0x04000001;
constexpr std::uint32_t kDecrementer = 0x900;

// A refusal is for reading: on the chip's port where the card's are missing. Without either nothing can be said.
void open_some_console(const ppc603e::Bus& bus) {
  if (bus.card) return open_console(port_registers(kConsolePort));
  if (bus.chip) open_console(ppc603e::kChipSerial);
}

}  // namespace

[[gnu::section(".board_id"), gnu::used]] const char board_id[32] = "3dlasso board ppc603e-grackle";
const std::uint32_t nominal_ticks_per_s = 16600000;

void check_board() {
  const ppc603e::Bus bus = ppc603e::open_bus();
  open_some_console(bus);
  const std::uint32_t version = ppc603e::processor_version() >> 16;
  if (version != ppc603e::kProcessor603e && version != ppc603e::kProcessor603eV)
    stop("the image is for another board: the processor is not a 603e");
  if (!bus.bridge) stop("the image is for another board: no Grackle bridge");
  if (!bus.chip) stop("the image is for another board: no Heathrow chip");
  if (!bus.card) stop("the image is for another board: no serial card of four ports");
}

std::uint32_t port_registers(std::uint32_t port) { return ppc603e::serial_registers(port); }

void unmask_line_interrupts() { ppc603e::unmask_serial_interrupt(); }

void mask_line_interrupts() { ppc603e::mask_serial_interrupt(); }

void map_devices() { ppc603e::set_last_data_block(kDevices, kDevicesHow); }

void map_loaded() { ppc603e::set_last_data_block(kLoaded, kLoadedHow); }

std::uint32_t fault_address(const FaultRegisters& r) {
  const std::uint32_t data_miss = r.more[0], code_miss = r.more[1];
  switch (r.vector) {
    case 0x300:
    case 0x600:
      return r.data_address;
    case 0x1100:
    case 0x1200:
      return data_miss;
    case 0x1000:
      return code_miss;
    default:
      return r.instruction;
  }
}

}  // namespace lasso::bare

void board_interrupt(std::uint32_t vector) {
  if (vector == lasso::bare::kDecrementer) return lasso::bare::serve_wake_up();
  return lasso::bare::serve_lines();
}
