// The board's bus: a Grackle bridge, a card with four 16550 serial ports, and the interrupt controller of the Heathrow chip.
#pragma once

#include <cstdint>

namespace lasso::ppc603e {

// Finds the devices and gives them their addresses; all their interrupts are masked. False: this is another board.
bool open_bus();
// Registers of one of the four serial ports.
std::uint32_t serial_registers(std::uint32_t port);
// The serial card's interrupt, from now on.
void unmask_serial_interrupt();
void mask_serial_interrupt();

}  // namespace lasso::ppc603e
