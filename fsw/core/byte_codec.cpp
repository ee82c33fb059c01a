#include "fsw/core/byte_codec.hpp"

#include <cstring>

#include "fsw/core/bits.hpp"

namespace lasso {
namespace {

// Shifts, not byte swaps: right on hosts of either byte order.
template <class U>
void store(std::uint8_t* to, U value) {
  for (std::size_t i = 0; i < sizeof(U); ++i) to[i] = static_cast<std::uint8_t>((value >> (8 * (sizeof(U) - 1 - i))) & 0xFFU);
}

}  // namespace

bool ByteWriter::reserve(std::size_t n) {
  ok_ = ok_ && n <= buffer_.size() - size_;
  if (ok_) size_ += n;
  return ok_;
}

void ByteWriter::u8(std::uint8_t value) {
  if (reserve(1)) buffer_.data()[size_ - 1] = value;
}

void ByteWriter::u16(std::uint16_t value) {
  if (reserve(sizeof(value))) store(buffer_.data() + size_ - sizeof(value), value);
}

void ByteWriter::u32(std::uint32_t value) {
  if (reserve(sizeof(value))) store(buffer_.data() + size_ - sizeof(value), value);
}

void ByteWriter::u64(std::uint64_t value) {
  if (reserve(sizeof(value))) store(buffer_.data() + size_ - sizeof(value), value);
}

void ByteWriter::f32(float value) { u32(same_bits<std::uint32_t>(value)); }
void ByteWriter::f64(double value) { u64(same_bits<std::uint64_t>(value)); }

void ByteWriter::bytes(ConstBytes value) {
  // An empty span may hold a null pointer, which memmove must not see.
  if (!value.empty() && reserve(value.size())) std::memmove(buffer_.data() + size_ - value.size(), value.data(), value.size());
}

std::uint64_t ByteReader::u64() {
  if (!take(sizeof(std::uint64_t))) return 0;
  const std::uint8_t* const from = buffer_.data() + position_ - sizeof(std::uint64_t);
  return std::uint64_t{word(from)} << 32 | word(from + sizeof(std::uint32_t));
}

float ByteReader::f32() { return same_bits<float>(u32()); }
double ByteReader::f64() { return same_bits<double>(u64()); }

ConstBytes ByteReader::bytes(std::size_t n) { return take(n) ? buffer_.subspan(position_ - n, n) : ConstBytes(); }

}  // namespace lasso
