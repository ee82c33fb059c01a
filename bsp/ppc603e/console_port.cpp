#include "bsp/bare/console.hpp"
#include "bsp/ppc603e/board_bus.hpp"
#include "bsp/ppc603e/uart.hpp"

namespace lasso::bare {

using ppc603e::ChipUart;
using ppc603e::kChipSerial;
using ppc603e::Uart;

void open_console_port(std::uint32_t registers) {
  if (registers == kChipSerial) return ChipUart::open(registers);
  ppc603e::write_device(registers + Uart::kEnable, 0);
  ppc603e::write_device(registers + Uart::kLineControl, Uart::kEightBits);
  ppc603e::write_device(registers + Uart::kFifoControl, Uart::kFifoOn);
}

bool console_port_ready(std::uint32_t registers) {
  if (registers == kChipSerial) return ChipUart::can_send(registers);
  return Uart::can_send(ppc603e::read_device(registers + Uart::kLineStatus));
}

void write_console_port(std::uint32_t registers, std::uint8_t letter) {
  if (registers == kChipSerial) return ChipUart::write(registers, letter);
  Uart::write(registers, letter);
}

}  // namespace lasso::bare
