// What a board gives beside its processor (cpu.hpp) and its serial ports (serial_port.hpp), and what its assembler calls. A board's folder
// defines all of the first part; start-up and vectors are its own, and the linker's script takes sections.ld of this room.
#pragma once

#include <cstdint>

namespace lasso::bare {

// --- the board's

// "3dlasso board ..." in the section .board_id, which tells whose image this is, also to who has not started it. The name follows.
extern const char board_id[32];
constexpr std::uint32_t kBoardNameAt = 14;

constexpr std::uint32_t kCameraPort = 0, kGroundPort = 1, kRigPort = 2, kConsolePort = 3;
// Registers of a serial port, of those four.
std::uint32_t port_registers(std::uint32_t port);

// Finds the devices, opens the console, and stops where this is another board or processor. All devices' interrupts are masked.
void check_board();
// Those of the serial ports that have rings; masked, they wait.
void unmask_line_interrupts();
void mask_line_interrupts();

// Ticks of the time base a second, where no strap says another number.
extern const std::uint32_t nominal_ticks_per_s;

// What was loaded (loaded.hpp) can be read, devices may be out of reach; and the other way round, as a start has it. With interrupts
// forbidden.
void map_loaded();
void map_devices();

// --- this room's, for start-up and vectors

// Of the wake-up call. Interrupts are forbidden; another interrupt may come within it.
void serve_wake_up();
// Of the serial ports. Interrupts are forbidden.
void serve_lines();

// Says why on the console and rests for ever.
[[noreturn]] void stop(const char* why);

}  // namespace lasso::bare

extern "C" {
// From start-up, on the estimation's stack: initial values, zeros, paint on both stacks and floating point (to nearest, no traps) are
// there.
[[noreturn]] void board_main();
}
