#include "bsp/bare/console.hpp"
#include "bsp/cortexa9/uart.hpp"

namespace lasso::bare {

using cortexa9::Uart;

void open_console_port(std::uint32_t registers) { Uart::reset(registers); }

bool console_port_ready(std::uint32_t registers) { return (cortexa9::read_device(registers + Uart::kFlags) & Uart::kFull) == 0; }

void write_console_port(std::uint32_t registers, std::uint8_t letter) { Uart::write(registers, letter); }

}  // namespace lasso::bare
