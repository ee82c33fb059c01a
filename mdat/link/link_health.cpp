#include "mdat/link/link_health.hpp"

#include <algorithm>

#include "fsw/link/space_packet.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint16_t kApidMask = 0x7FF, kCountMask = 0x3FFF;
constexpr std::uint16_t kHalfOfHealthCounts = kCountMask / 2;

std::uint16_t word_at(ConstBytes bytes, std::size_t at) { return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]); }

double seconds_between(LinkHealth::Time from, LinkHealth::Time to) { return std::chrono::duration<double>(to - from).count(); }

}  // namespace

void LinkHealth::take(ConstBytes packets, Time now) {
  std::uint64_t taken = 0;
  while (const std::size_t size = packet_size(packets)) {
    if (size > packets.size()) break;
    const auto apid = static_cast<std::uint16_t>(word_at(packets, 0) & kApidMask);
    const auto count = static_cast<std::uint16_t>(word_at(packets, 2) & kCountMask);
    const auto last = counts_.find(apid);
    const auto ahead = static_cast<std::uint16_t>(last == counts_.end() ? 1 : (count - last->second) & kCountMask);
    if (ahead > 1 && ahead <= kHalfOfHealthCounts) missing_ += ahead - 1U;
    counts_[apid] = count;
    packets = packets.subspan(size, packets.size() - size);
    ++taken;
  }
  if (taken == 0) return;
  if (packets_ == 0) first_ = now;
  packets_ += taken;
  recent_.push_back({now, taken});
  while (recent_.size() > 1 && now - recent_.front().at > kRateWindow) recent_.pop_front();
}

double LinkHealth::rate_per_s(Time now) const {
  if (packets_ == 0) return 0;
  std::uint64_t sum = 0;
  for (const Batch& batch : recent_) {
    if (now - batch.at < kRateWindow) sum += batch.packets;
  }
  const double window_s = std::chrono::duration<double>(kRateWindow).count();
  return static_cast<double>(sum) / std::clamp(seconds_between(first_, now), 1.0, window_s);
}

double LinkHealth::age_s(Time now) const { return packets_ == 0 ? -1 : seconds_between(recent_.back().at, now); }

}  // namespace lasso::mdat
