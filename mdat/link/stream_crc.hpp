// Checksums of any piece of a stream, each in constant time.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/core/span.hpp"

namespace lasso::mdat {

// A CRC is linear: the register behind bytes a to b, begun with s at a, is R[b] + (R[a] + s) x^(8(b - a)) modulo the polynomial, over
// GF(2), where R[i] is the register behind the first i bytes, begun with 0. Bytes that look like headers cost no checksum over what they
// announce.
class StreamCrc {
 public:
  // `stream` is read here alone. Takes 2 bytes of memory a byte.
  explicit StreamCrc(ConstBytes stream);

  // Whether CRC-16/CCITT-FALSE over these bytes, its own two at their end among them, is right. They have to be in the stream, and at most
  // the largest space packet.
  bool right(std::size_t offset, std::size_t size) const;

 private:
  std::vector<std::uint16_t> registers_;
};

}  // namespace lasso::mdat
