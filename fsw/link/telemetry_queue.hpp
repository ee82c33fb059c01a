// Whole packets waiting for the link, first in, first out. What does not fit is dropped and counted: what is in the queue stays.
// Used by one thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"

namespace lasso {

class TelemetryQueue {
 public:
  // kOverCapacity: counted as dropped, the queue is unchanged. kBadLength: not one whole packet. Loop bound: the packet's bytes.
  Status push(ConstBytes packet);
  // Moves the oldest packets that fit whole into `out`, and returns their bytes. Loop bound: kTelemetryQueueBytes.
  std::size_t take(Bytes out);

  std::size_t size() const { return size_; }
  std::size_t peak() const { return peak_; }
  std::uint32_t dropped() const { return dropped_; }

 private:
  std::size_t front_packet_size() const;
  std::uint8_t pop();
  std::uint8_t bytes_[kTelemetryQueueBytes] = {};
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::size_t peak_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace lasso
