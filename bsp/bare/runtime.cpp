// What the compiler takes for granted: copies of memory, and functions at exit, which never comes.
#include <cstddef>
#include <cstdint>

#include "bsp/bare/bytes.hpp"

extern "C" {

void* memcpy(void* to, const void* from, std::size_t count) {
  lasso::bare::copy_up(static_cast<std::uint8_t*>(to), static_cast<const std::uint8_t*>(from), count);
  return to;
}

void* memmove(void* to, const void* from, std::size_t count) {
  lasso::bare::move(static_cast<std::uint8_t*>(to), static_cast<const std::uint8_t*>(from), count);
  return to;
}

void* memset(void* to, int value, std::size_t count) {
  lasso::bare::fill(static_cast<std::uint8_t*>(to), static_cast<std::uint8_t>(value), count);
  return to;
}

int memcmp(const void* one, const void* other, std::size_t count) {
  return lasso::bare::compare(static_cast<const std::uint8_t*>(one), static_cast<const std::uint8_t*>(other), count);
}

int __cxa_atexit(void (*)(void*), void*, void*) { return 0; }  // NOLINT(bugprone-reserved-identifier): the compiler asks for this name
void* __dso_handle = nullptr;                                  // NOLINT(bugprone-reserved-identifier): likewise
}
