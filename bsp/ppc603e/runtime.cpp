// What the compiler takes for granted: copies of memory, and functions at exit, which never comes.
#include <cstddef>
#include <cstdint>

extern "C" {

void* memcpy(void* to, const void* from, std::size_t count) {
  auto* out = static_cast<std::uint8_t*>(to);
  const auto* in = static_cast<const std::uint8_t*>(from);
  const bool words = ((reinterpret_cast<std::uintptr_t>(out) | reinterpret_cast<std::uintptr_t>(in)) & 3) == 0;
  for (; words && count >= 4; count -= 4, out += 4, in += 4) {
    using Word [[gnu::may_alias]] = std::uint32_t;
    *reinterpret_cast<Word*>(out) = *reinterpret_cast<const Word*>(in);
  }
  for (; count > 0; --count) *out++ = *in++;
  return to;
}

void* memmove(void* to, const void* from, std::size_t count) {
  auto* out = static_cast<std::uint8_t*>(to);
  const auto* in = static_cast<const std::uint8_t*>(from);
  if (out <= in || out >= in + count) return memcpy(to, from, count);
  for (; count > 0; --count) out[count - 1] = in[count - 1];
  return to;
}

void* memset(void* to, int value, std::size_t count) {
  auto* out = static_cast<std::uint8_t*>(to);
  const auto byte = static_cast<std::uint8_t>(value);
  const std::uint32_t four = byte * 0x01010101u;
  for (; count > 0 && (reinterpret_cast<std::uintptr_t>(out) & 3) != 0; --count) *out++ = byte;
  for (; count >= 4; count -= 4, out += 4) {
    using Word [[gnu::may_alias]] = std::uint32_t;
    *reinterpret_cast<Word*>(out) = four;
  }
  for (; count > 0; --count) *out++ = byte;
  return to;
}

int memcmp(const void* one, const void* other, std::size_t count) {
  const auto* a = static_cast<const std::uint8_t*>(one);
  const auto* b = static_cast<const std::uint8_t*>(other);
  for (; count > 0; --count, ++a, ++b) {
    if (*a != *b) return *a < *b ? -1 : 1;
  }
  return 0;
}

int __cxa_atexit(void (*)(void*), void*, void*) { return 0; }  // NOLINT(bugprone-reserved-identifier): the compiler asks for this name
void* __dso_handle = nullptr;                                  // NOLINT(bugprone-reserved-identifier): likewise
}
