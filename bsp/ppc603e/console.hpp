// A few words for people, on a line of their own, without interrupts. It works from the first instruction of board_main() on.
#pragma once

#include <cstdint>

namespace lasso::ppc603e {

void open_console(std::uint32_t registers);
void say(const char* text);
void say_hex(const char* label, std::uint32_t value);
void say_number(const char* label, std::uint32_t value);

}  // namespace lasso::ppc603e
