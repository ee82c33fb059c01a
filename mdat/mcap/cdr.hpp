// Common data representation (OMG, XCDR version 1, little-endian), as ROS 2 serialises messages: each number at a multiple of its own size,
// counted from behind the four bytes of the encapsulation.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mdat/mcap/bytes.hpp"

namespace lasso::mdat::mcap {

class CdrWriter {
 public:
  template <class T>
  CdrWriter& put(T value) {
    align(sizeof(T));
    mcap::put(value, bytes_);
    return *this;
  }
  // With its end mark, which counts.
  CdrWriter& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.append(value).push_back('\0');
    return *this;
  }
  CdrWriter& blob(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size()));
    bytes_.append(value);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kEncapsulation = 4;
  void align(std::size_t size) { bytes_.resize(kEncapsulation + (bytes_.size() - kEncapsulation + size - 1) / size * size, '\0'); }

  std::string bytes_{'\0', '\1', '\0', '\0'};
};

// The same way back; beyond the end as ByteReader.
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes) : size_(bytes.size()), reader_(bytes) {
    const std::string_view head = reader_.take(kEncapsulation);
    little_ = head.size() == kEncapsulation && head[0] == '\0' && head[1] == '\1';
  }

  bool ok() const { return little_ && reader_.ok(); }
  template <class T>
  T get() {
    const std::size_t at = size_ - reader_.rest().size() - kEncapsulation;
    (void)reader_.take((sizeof(T) - at % sizeof(T)) % sizeof(T));
    return reader_.get<T>();
  }
  std::string_view text() {
    const auto size = get<std::uint32_t>();
    const std::string_view whole = reader_.take(size);
    return whole.substr(0, whole.empty() ? 0 : whole.size() - 1);
  }
  std::string_view blob() {
    const auto size = get<std::uint32_t>();
    return reader_.take(size);
  }
  std::string_view take(std::size_t size) { return reader_.take(size); }  // bytes
  std::size_t left() const { return reader_.rest().size(); }

 private:
  static constexpr std::size_t kEncapsulation = 4;
  std::size_t size_;
  ByteReader reader_;
  bool little_ = false;
};

}  // namespace lasso::mdat::mcap
