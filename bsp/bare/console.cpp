#include "bsp/bare/console.hpp"

namespace lasso::bare {
namespace {

constexpr std::uint32_t kPatience = 100000;
std::uint32_t registers_at = 0;

void put(char letter) {
  if (registers_at == 0) return;
  for (std::uint32_t i = 0; i < kPatience && !console_port_ready(registers_at); ++i) {
  }
  write_console_port(registers_at, static_cast<std::uint8_t>(letter));
}

}  // namespace

void open_console(std::uint32_t registers) {
  registers_at = registers;
  open_console_port(registers);
}

void say(const char* text) {
  for (; *text != '\0'; ++text) put(*text);
}

void say_hex(const char* label, std::uint32_t value) {
  say(label);
  for (std::uint32_t shift = 32; shift > 0; shift -= 4) put("0123456789abcdef"[value >> (shift - 4) & 15]);
}

void say_number(const char* label, std::uint32_t value) {
  char digits[11] = {};
  std::uint32_t at = 10;
  do {
    digits[--at] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value > 0);
  say(label);
  say(digits + at);
}

}  // namespace lasso::bare
