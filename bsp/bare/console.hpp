// A few words for people, on a line of their own, without interrupts. It works from the first instruction of board_main() on.
#pragma once

#include <cstdint>

namespace lasso::bare {

// Without it nothing is said, and nothing is waited for.
void open_console(std::uint32_t registers);
void say(const char* text);
void say_hex(const char* label, std::uint32_t value);
void say_number(const char* label, std::uint32_t value);

// The board's: a port without interrupts; whether it can take a letter; one more letter.
void open_console_port(std::uint32_t registers);
bool console_port_ready(std::uint32_t registers);
void write_console_port(std::uint32_t registers, std::uint8_t letter);

}  // namespace lasso::bare
