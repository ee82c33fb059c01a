// Big-endian reading and writing within a fixed buffer. An overrun never touches memory: it sets a sticky failure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

class ByteWriter {
 public:
  explicit ByteWriter(Bytes buffer) : buffer_(buffer) {}

  void u8(std::uint8_t value);
  void u16(std::uint16_t value);
  void u32(std::uint32_t value);
  void u64(std::uint64_t value);
  void i16(std::int16_t value) { u16(static_cast<std::uint16_t>(value)); }
  void i32(std::int32_t value) { u32(static_cast<std::uint32_t>(value)); }
  void i64(std::int64_t value) { u64(static_cast<std::uint64_t>(value)); }
  void f32(float value);   // IEEE 754 binary32
  void f64(double value);  // IEEE 754 binary64
  void bytes(ConstBytes value);

  std::size_t size() const { return size_; }
  bool ok() const { return ok_; }  // false once something did not fit
  ConstBytes written() const { return {buffer_.data(), size_}; }

 private:
  bool reserve(std::size_t n);
  Bytes buffer_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

class ByteReader {
 public:
  explicit ByteReader(ConstBytes buffer) : buffer_(buffer) {}

  // Past the end: 0, and ok() is false from then on.
  // Inline: a few instructions where a call takes thirty, and a scan has ten thousand of them.
  std::uint8_t u8() { return *next(1); }
  std::uint16_t u16() {
    const std::uint8_t* const at = next(2);
    return static_cast<std::uint16_t>(at[0] << 8 | at[1]);
  }
  std::uint32_t u32() { return word(next(4)); }
  std::uint64_t u64();
  std::int16_t i16() { return static_cast<std::int16_t>(u16()); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  std::int64_t i64() { return static_cast<std::int64_t>(u64()); }
  float f32();
  double f64();
  ConstBytes bytes(std::size_t n);  // empty past the end

  std::size_t remaining() const { return buffer_.size() - position_; }
  std::size_t position() const { return position_; }
  bool ok() const { return ok_; }

 private:
  bool take(std::size_t n) {
    ok_ = ok_ && n <= remaining();
    if (ok_) position_ += n;
    return ok_;
  }
  // The next n bytes, at most 4; past the end zeros.
  const std::uint8_t* next(std::size_t n) { return take(n) ? buffer_.data() + position_ - n : kZeros; }
  static std::uint32_t word(const std::uint8_t* at) {
    return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
  }
  static constexpr std::uint8_t kZeros[4] = {};
  ConstBytes buffer_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace lasso
