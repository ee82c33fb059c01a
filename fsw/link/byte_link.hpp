// What carries the link's bytes: a serial line, a socket, a file. Either a stream of bytes, in which packets are found by their headers
// and checksums, or datagrams of one packet each. No call waits.
#pragma once

#include <cstddef>

#include "fsw/core/span.hpp"

namespace lasso {

class ByteLink {
 public:
  virtual bool datagrams() const = 0;
  // What has come from the ground, at most out.size() bytes; 0: nothing. Of datagrams one, and what of it `out` does not hold is lost.
  virtual std::size_t read(Bytes out) = 0;
  // Bytes that it takes of `packets`, which may be none. Of datagrams one packet, whole or not at all.
  virtual std::size_t write(ConstBytes packets) = 0;
  // The datagram that was read last has been checked, and came from the other end: a component heard who may command, the ground its
  // component. A link on which anybody may speak answers to these alone.
  virtual void peer_spoke() {}

 protected:
  ~ByteLink() = default;  // never deleted through this interface: no operator delete in flight code
};

}  // namespace lasso
