// The board's bus: a Grackle bridge, a card with four 16550 serial ports, and the interrupt controller of the Heathrow chip.
#pragma once

#include <cstdint>

namespace lasso::ppc603e {

constexpr std::uint32_t kPorts = 4;

// Finds the devices and gives them their addresses; all their interrupts are masked. False: this is another board.
bool open_bus();
// Registers of a serial port.
std::uint32_t port_registers(std::uint32_t port);
// The serial card's interrupt, from now on.
void unmask_serial_interrupt();
void mask_serial_interrupt();

}  // namespace lasso::ppc603e
