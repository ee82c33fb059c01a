// Between a component and its link: commands in, telemetry out. Used by the thread that runs the component's slots, once a slot or as
// often as it likes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/exec/component.hpp"
#include "fsw/link/byte_link.hpp"

namespace lasso {

class LinkPump {
 public:
  LinkPump(Component& component, ByteLink& link) : component_(component), link_(link) {}

  // Hands over what has come, as far as the frame has room for commands; the rest waits here and in the link. Loop bound: kMaxReads.
  void receive(TimeUs now_us);
  // Writes the telemetry that waits, as far as the link takes it; the rest waits here and in the component's queue. Loop bound:
  // kMaxWrites.
  void send();

 private:
  static constexpr std::size_t kMaxReads = 16;
  static constexpr std::size_t kMaxWrites = 64;
  bool hand_over(TimeUs now_us);
  std::size_t hand_over_datagram(TimeUs now_us);
  bool write_some();

  Component& component_;
  ByteLink& link_;
  std::uint8_t in_[kMaxCommandBytes + 1] = {};  // a datagram that is too long for a command stays too long
  std::size_t in_size_ = 0;
  std::uint8_t out_[kMaxPosePacketBytes] = {};
  std::size_t out_begin_ = 0, out_end_ = 0;
};

}  // namespace lasso
