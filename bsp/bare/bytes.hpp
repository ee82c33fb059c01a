// Copies, fills and compares memory, for the functions of the C library that the compiler calls (runtime.cpp). No address needs to be
// aligned: where the processor does not split a word, the compiler does. Not for devices.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lasso::bare {

using Word [[gnu::may_alias, gnu::aligned(1)]] = std::uint32_t;
constexpr std::size_t kWordBytes = sizeof(std::uint32_t);

inline std::uint32_t word_at(const std::uint8_t* at) { return *reinterpret_cast<const Word*>(at); }
inline void put_word(std::uint8_t* at, std::uint32_t word) { *reinterpret_cast<Word*>(at) = word; }

// Upwards: from memory that does not overlap, or begins above `to`.
inline void copy_up(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
  for (; count >= 4 * kWordBytes; count -= 4 * kWordBytes, to += 4 * kWordBytes, from += 4 * kWordBytes) {
    const std::uint32_t words[4] = {word_at(from), word_at(from + kWordBytes), word_at(from + 2 * kWordBytes),
                                    word_at(from + 3 * kWordBytes)};
    for (std::size_t i = 0; i < 4; ++i) put_word(to + i * kWordBytes, words[i]);
  }
  for (; count >= kWordBytes; count -= kWordBytes, to += kWordBytes, from += kWordBytes) put_word(to, word_at(from));
  for (; count > 0; --count) *to++ = *from++;
}

// Wherever they lie.
inline void move(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
  if (to <= from || to >= from + count) return copy_up(to, from, count);
  for (; count > 0; --count) to[count - 1] = from[count - 1];
}

inline void fill(std::uint8_t* to, std::uint8_t byte, std::size_t count) {
  const std::uint32_t four = byte * 0x01010101U;
  for (; count >= kWordBytes; count -= kWordBytes, to += kWordBytes) put_word(to, four);
  for (; count > 0; --count) *to++ = byte;
}

// Below, at or above 0, as the first byte that differs is.
inline int compare(const std::uint8_t* one, const std::uint8_t* other, std::size_t count) {
  for (; count > 0; --count, ++one, ++other) {
    if (*one != *other) return *one < *other ? -1 : 1;
  }
  return 0;
}

}  // namespace lasso::bare
