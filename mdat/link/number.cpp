#include "mdat/link/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "fsw/core/byte_codec.hpp"

namespace lasso::mdat {
namespace {

constexpr double kRounding = 1e-6;  // of the largest magnitude in the range

}  // namespace

std::string text_of(const Number& number) {
  std::array<char, 40> text{};
  const auto write = [&](const auto value) { return std::to_chars(text.data(), text.data() + text.size(), value).ptr; };
  return {text.data(), std::visit(write, number)};
}

double value_of(const Number& number) {
  return std::visit([](const auto value) { return static_cast<double>(value); }, number);
}

Number read_number(WireType type, ConstBytes bytes) {
  ByteReader in(bytes.first(wire_size(type)));
  switch (type) {
    case WireType::kU8:
      return static_cast<std::int64_t>(in.u8());
    case WireType::kU16:
      return static_cast<std::int64_t>(in.u16());
    case WireType::kU32:
      return static_cast<std::int64_t>(in.u32());
    case WireType::kI64:
      return in.i64();
    case WireType::kF32:
      return in.f32();
    case WireType::kF64:
      break;
  }
  return in.f64();
}

std::uint64_t read_bits(ConstBytes bytes, std::size_t bit, std::size_t bits) {
  std::uint64_t value = 0;
  for (std::size_t i = bit; i < bit + bits; ++i) value = value << 1 | (static_cast<std::uint64_t>(bytes[i / 8]) >> (7 - i % 8) & 1U);
  return value;
}

bool in_range(const ItemRow& row, const Number& number) {
  const double value = value_of(number);
  const double low = row.range.minimum, high = row.range.maximum;
  const double largest = std::fmax(std::isinf(low) ? 0 : std::fabs(low), std::isinf(high) ? 0 : std::fabs(high));
  const double slack = row.type == WireType::kF32 || row.type == WireType::kF64 ? kRounding * largest : 0;
  return value >= low - slack && value <= high + slack;
}

const Choice* choice_of(const ItemRow& row, const Number& number) {
  const auto* value = std::get_if<std::int64_t>(&number);
  if (row.enumeration == nullptr || value == nullptr) return nullptr;
  const auto& choices = row.enumeration->choices;
  return static_cast<std::size_t>(*value) < choices.size() ? &choices[static_cast<std::size_t>(*value)] : nullptr;
}

}  // namespace lasso::mdat
