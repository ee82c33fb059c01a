#include "fsw/link/row.hpp"

namespace lasso {
namespace {

constexpr const char* kNames[] = {"u8", "u16", "u32", "i64", "f32", "f64"};

}  // namespace

const char* to_string(WireType type) { return Span<const char* const>(kNames)[static_cast<std::size_t>(type)]; }

}  // namespace lasso
