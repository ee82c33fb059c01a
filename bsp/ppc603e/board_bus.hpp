// The board's bus: a Grackle bridge, a card with four 16550 serial ports, and the interrupt controller of the Heathrow chip.
#pragma once

#include <cstdint>

namespace lasso::ppc603e {

// What is there.
struct Bus {
  bool bridge = false, chip = false, card = false;
  bool whole() const { return bridge && chip && card; }
};
// Finds the devices and gives them their addresses; all their interrupts are masked. Where one is missing this is another board.
Bus open_bus();
// Registers of one of the four serial ports.
std::uint32_t serial_registers(std::uint32_t port);
// Of the chip's own first port (ChipUart, uart.hpp), which is the console where the card is missing.
constexpr std::uint32_t kChipSerial = 0xFD013020;
// The serial card's interrupt, from now on.
void unmask_serial_interrupt();
void mask_serial_interrupt();

}  // namespace lasso::ppc603e
