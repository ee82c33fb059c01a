#include "fsw/exec/link_pump.hpp"

#include <cstring>

namespace lasso {

void LinkPump::receive(TimeUs now_us) {
  bool room = in_size_ == 0 || hand_over(now_us);
  for (std::size_t i = 0; i < kMaxReads && room; ++i) {
    in_size_ = link_.read(Bytes(in_));
    if (in_size_ == 0) return;
    room = hand_over(now_us);
  }
}

// True: nothing waits here any more.
bool LinkPump::hand_over(TimeUs now_us) {
  const ConstBytes bytes(in_, in_size_);
  const std::size_t taken = link_.datagrams() ? hand_over_datagram(now_us) : component_.receive(bytes, now_us);
  in_size_ -= taken;
  std::memmove(in_, in_ + taken, in_size_);
  return in_size_ == 0;
}

// All of it, or nothing.
std::size_t LinkPump::hand_over_datagram(TimeUs now_us) {
  if (!component_.receive_packet({in_, in_size_}, now_us)) return 0;
  if (component_.heard_operator()) link_.peer_spoke();
  return in_size_;
}

void LinkPump::send() {
  bool more = true;
  for (std::size_t i = 0; i < kMaxWrites && more; ++i) more = write_some();
}

// False: there is nothing to write, or the link takes no more.
bool LinkPump::write_some() {
  if (out_begin_ == out_end_) {
    out_begin_ = 0;
    out_end_ = component_.take_telemetry(Bytes(out_));
  }
  const ConstBytes rest(out_ + out_begin_, out_end_ - out_begin_);
  if (rest.empty()) return false;
  const std::size_t written = link_.write(link_.datagrams() ? rest.first(packet_size(rest)) : rest);
  out_begin_ += written;
  return written > 0;
}

}  // namespace lasso
