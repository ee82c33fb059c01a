// Whole packets waiting for the link, first in, first out. What does not fit is dropped and counted: what is in the queue stays. Answers
// to commands have room of their own behind the rest, so that no other telemetry keeps them from the operator. Used by one thread.
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
  Status push(ConstBytes packet) { return push(packet, kTelemetryQueueBytes); }
  // As push(); an answer to a command, which has kAnswerBytes more.
  Status push_answer(ConstBytes packet) { return push(packet, kCapacity); }
  // Moves the oldest packets that fit whole into `out`, and returns their bytes. Loop bound: the queue's bytes.
  std::size_t take(Bytes out);

  std::size_t size() const { return size_; }
  std::size_t peak() const { return peak_; }
  std::uint32_t dropped() const { return dropped_; }

 private:
  static constexpr std::size_t kCapacity = kTelemetryQueueBytes + kAnswerBytes;
  Status push(ConstBytes packet, std::size_t most);
  std::size_t front_packet_size() const;
  std::uint8_t pop();
  std::uint8_t bytes_[kCapacity] = {};
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::size_t peak_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace lasso
