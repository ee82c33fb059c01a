// Values of packets as numbers and as text.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "fsw/link/row.hpp"

namespace lasso::mdat {

using Number = std::variant<std::int64_t, float, double>;  // integers of the wire fit the first

// The shortest text that reads back as the same number; "nan", "inf", "-inf".
std::string text_of(const Number& number);
inline std::string real_text(double value) { return text_of(Number(value)); }
double value_of(const Number& number);

// The element at the start of `bytes`, which has to be whole.
Number read_number(WireType type, ConstBytes bytes);

// Bits of a header, most significant first.
std::uint64_t read_bits(ConstBytes bytes, std::size_t bit, std::size_t bits);

// Within the item's range, or beyond it by no more than rounding does.
bool in_range(const ItemRow& row, const Number& number);

// The name of an enumeration's value; null where it has none.
const Choice* choice_of(const ItemRow& row, const Number& number);

}  // namespace lasso::mdat
