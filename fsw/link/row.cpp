#include "fsw/link/row.hpp"

namespace lasso {
namespace {

struct WireTypeFacts {
  WireType type;
  const char* name;
  std::size_t size;
};

constexpr WireTypeFacts kFacts[] = {{WireType::kU8, "u8", 1},   {WireType::kU16, "u16", 2}, {WireType::kU32, "u32", 4},
                                    {WireType::kI64, "i64", 8}, {WireType::kF32, "f32", 4}, {WireType::kF64, "f64", 8}};

const WireTypeFacts& facts(WireType type) { return Span<const WireTypeFacts>(kFacts)[static_cast<std::size_t>(type)]; }

}  // namespace

const char* to_string(WireType type) { return facts(type).name; }

std::size_t wire_size(WireType type) { return facts(type).size; }

}  // namespace lasso
