#include "bsp/posix/udp_peers.hpp"

#include <algorithm>

#include "fsw/link/link_report.hpp"

namespace lasso::posix {
namespace {

bool same(const sockaddr_in& a, const sockaddr_in& b) { return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port; }

template <class List>
bool holds(const List& list, const sockaddr_in& address) {
  return std::any_of(list.begin(), list.end(), [&](const sockaddr_in& one) { return same(one, address); });
}

}  // namespace

bool UdpPeers::has_place(const sockaddr_in& address) const {
  return holds(configured_, address) ||
         std::any_of(places_.begin(), places_.end(), [&](const Place& place) { return same(place.address, address); });
}

// One more stranger.
bool UdpPeers::is_crowded(Time now) {
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    strangers_ = 0;
  }
  return ++strangers_ > kStrangersPerSecond;
}

bool UdpPeers::heard(const sockaddr_in& from, ConstBytes datagram, Time now) {
  if (!has_place(from) && is_crowded(now)) return false;
  asked_[next_] = {command_key(datagram), from, true};
  next_ = (next_ + 1) % kAsked;
  return true;
}

void UdpPeers::vouch(Time now) {
  const sockaddr_in& from = asked_[(next_ + kAsked - 1) % kAsked].address;
  const auto known = std::find_if(places_.begin(), places_.end(), [&](const Place& place) { return same(place.address, from); });
  if (known != places_.end()) {
    known->heard = now;
    return;
  }
  drop_silent(now);
  if (places_.push_back({from, now})) return;
  *std::min_element(places_.begin() + 1, places_.end(), [](const Place& a, const Place& b) { return a.heard < b.heard; }) = {from, now};
}

void UdpPeers::drop_silent(Time now) {
  FixedVector<Place, kPlaces> left;
  for (const Place& place : places_) {
    if (now - place.heard < kSilent) static_cast<void>(left.push_back(place));
  }
  places_ = left;
}

UdpPeers::List UdpPeers::receivers(ConstBytes packet) const {
  List list;
  for (const sockaddr_in& address : configured_) static_cast<void>(list.push_back(address));
  for (const Place& place : places_) {
    if (!holds(list, place.address)) static_cast<void>(list.push_back(place.address));
  }
  std::uint32_t key = 0;
  if (!is_answer(packet, key)) return list;
  for (std::size_t back = 1; back <= kAsked; ++back) {
    const Asked& asked = asked_[(next_ + kAsked - back) % kAsked];
    if (!asked.open || asked.key != key) continue;
    if (!holds(list, asked.address)) static_cast<void>(list.push_back(asked.address));
    break;
  }
  return list;
}

}  // namespace lasso::posix
