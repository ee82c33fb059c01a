#include "mdat/run/command_stream.hpp"

#include <algorithm>

namespace lasso::mdat {

std::size_t ListenedLink::read(Bytes out) {
  const std::size_t size = link_.read(out);
  if (size > 0) listener_.on_commands(clock_(), ConstBytes(out.data(), size));
  return size;
}

std::size_t ReplayedLink::read(Bytes out) {
  if (piece_ == stream_.pieces.size() || stream_.pieces[piece_].slot_us > clock_()) return 0;
  const std::vector<std::uint8_t>& bytes = stream_.pieces[piece_].bytes;
  const std::size_t size = std::min(out.size(), bytes.size() - at_);
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at_), size, out.data());
  at_ += size;
  if (at_ < bytes.size() && !stream_.datagrams) return size;
  ++piece_;
  at_ = 0;
  return size;
}

RunLink::RunLink(ByteLink* link, const CommandStream* stream, RunListener* listener, const SlotClock& clock) : used_(link) {
  if (link == nullptr && stream != nullptr) used_ = &replayed_.emplace(*stream, clock);
  if (used_ != nullptr && listener != nullptr) used_ = &listened_.emplace(*used_, *listener, clock);
}

}  // namespace lasso::mdat
