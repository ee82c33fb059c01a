// Numbers and texts as MCAP writes them: little-endian, a length of 32 bits before what has no fixed size.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lasso::mdat::mcap {

using Text = std::map<std::string, std::string>;  // of a channel, or a record of metadata

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers go as they lie in memory");

template <class T>
void put(T value, std::string& bytes) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_text(std::string_view text, std::string& bytes) {
  put(static_cast<std::uint32_t>(text.size()), bytes);
  bytes.append(text);
}

inline void put_map(const Text& map, std::string& bytes) {
  std::string inner;
  for (const auto& [key, value] : map) {
    put_text(key, inner);
    put_text(value, inner);
  }
  put_text(inner, bytes);
}

// What bytes say, from the front. A reader that has come beyond the end stays there: its values are empty, and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  std::string_view rest() const { return rest_; }

  template <class T>
  T get() {
    const std::string_view bytes = take(sizeof(T));
    T value{};
    if (ok_) std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }

  std::string_view take(std::uint64_t size) {
    ok_ = ok_ && size <= rest_.size();
    const std::string_view taken = rest_.substr(0, ok_ ? size : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view text() { return take(get<std::uint32_t>()); }

  Text map() {
    ByteReader inner(text());
    Text result;
    while (ok_ && inner.ok() && !inner.rest().empty()) {
      std::string key(inner.text());
      result[std::move(key)] = inner.text();
    }
    ok_ = ok_ && inner.ok();
    return result;
  }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace lasso::mdat::mcap
