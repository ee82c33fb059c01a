#include "mdat/link/packet_places.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace lasso::mdat {
namespace {

constexpr std::size_t kLeastWithCrc = kPrimaryHeaderBytes + kPacketTrailerBytes;
constexpr std::size_t kLongestPrefix = 32, kShortHeads = 64;
constexpr std::size_t kFalseHeaders = 1000;     // of an application, for one that is right
constexpr std::size_t kTriedBytes = 1U << 18U;  // of the stream, to find its first packet and the prefix

using Places = std::vector<PacketPlace>;
using Application = std::uint16_t;  // type and APID
using Applications = std::set<Application>;

class Stream {
 public:
  Stream(ConstBytes bytes, const StreamCrc& crc) : bytes_(bytes), crc_(crc) {}

  std::size_t size() const { return bytes_.size(); }
  Application application(std::size_t at) const { return static_cast<Application>(word(at) & 0x17FFU); }
  std::uint16_t count(std::size_t at) const { return static_cast<std::uint16_t>(word(at + 2) & kSequenceCountMask); }
  // Whether a header may stand here; what it announces may be cut off.
  bool begins(std::size_t at) const {
    if (at > size() || size() - at < kPrimaryHeaderBytes) return false;
    const ConstBytes header = bytes_.subspan(at, kPrimaryHeaderBytes);
    const bool fill = std::all_of(header.begin(), header.end(), [](std::uint8_t byte) { return byte == 0; });
    return read_primary_header(header).version == 0 && !fill;
  }
  // The size of the packet here; 0: none, or not whole.
  std::size_t packet(std::size_t at) const {
    if (!begins(at)) return 0;
    const std::size_t stated = packet_size(bytes_.subspan(at, kPrimaryHeaderBytes));
    return stated <= size() - at ? stated : 0;
  }
  bool right(std::size_t at) const {
    const std::size_t stated = packet(at);
    return stated >= kLeastWithCrc && crc_.right(at, stated);
  }
  // Packet after packet from `at`, a prefix before each but the first.
  Places chain(std::size_t at, std::size_t prefix, std::size_t end) const {
    Places places;
    for (std::size_t size = packet(at); size > 0 && at + size <= end; size = packet(at)) {
      places.push_back({at, size});
      at += size + prefix;
    }
    return places;
  }

 private:
  std::uint32_t word(std::size_t at) const { return std::uint32_t{bytes_[at]} << 8U | bytes_[at + 1]; }

  ConstBytes bytes_;
  const StreamCrc& crc_;
};

std::size_t end_of(const Places& places) { return places.empty() ? 0 : places.back().offset + places.back().size; }

std::size_t covered(const Places& places) {
  std::size_t bytes = 0;
  for (const PacketPlace& place : places) bytes += place.size;
  return bytes;
}

// What the search for right checksums met of an application.
struct Met {
  std::size_t headers = 0, right = 0;
  bool beside = false;  // a right packet touches another, or an end of the stream
};

// By their checksums, one behind the other; of the believed applications, or of all.
Places checked_places(const Stream& stream, const Applications* believed, std::map<Application, Met>& met) {
  Places places;
  for (std::size_t at = 0; at < stream.size();) {
    const bool header = stream.packet(at) >= kLeastWithCrc;
    const bool asked = header && (believed == nullptr || believed->count(stream.application(at)) > 0);
    const bool here = asked && stream.right(at);
    if (header) ++met[stream.application(at)].headers;
    if (here) places.push_back({at, stream.packet(at)});
    at += here ? places.back().size : 1;
  }
  return places;
}

// A checksum is right by chance once in 2^16. An application is believed where it has two that are right, or one that touches another, and
// these are more than one in a thousand of what looks like its headers.
Applications believed_applications(const Stream& stream) {
  std::map<Application, Met> met;
  const Places places = checked_places(stream, nullptr, met);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : places[i - 1].offset + places[i - 1].size;
    const std::size_t behind = i + 1 == places.size() ? stream.size() : places[i + 1].offset;
    Met& own = met[stream.application(places[i].offset)];
    ++own.right;
    own.beside = own.beside || places[i].offset == before || places[i].offset + places[i].size == behind;
  }
  Applications believed;
  for (const auto& [application, own] : met) {
    if ((own.beside || own.right > 1) && own.right * kFalseHeaders > own.headers) believed.insert(application);
  }
  return believed;
}

// Between two packets that are right, or behind the last: packets that are not.
class Room {
 public:
  Room(const Stream& stream, const Applications& believed, std::size_t begin, std::size_t end)
      : stream_(stream), believed_(believed), begin_(begin), end_(end) {}

  void fill(Places& places) const {
    const Places exact = stream_.chain(begin_, 0, end_);
    if (!exact.empty() && end_of(exact) == end_) {
      places.insert(places.end(), exact.begin(), exact.end());
      return;
    }
    const std::vector<bool> reaches = reaching();
    for (std::size_t at = begin_; at < end_;) {
      const std::size_t size = reaches[at - begin_] ? stream_.packet(at) : 0;
      if (size > 0) places.push_back({at, size});
      at += std::max<std::size_t>(size, 1);
    }
  }

 private:
  bool is_known(std::size_t at) const {
    const Application application = stream_.application(at);
    return (application & kIdleApid) == kIdleApid || believed_.count(application) > 0;
  }
  // The last packet of a stream may be cut.
  bool is_end(std::size_t at) const {
    if (at == end_) return true;
    if (end_ != stream_.size()) return false;
    return end_ - at < kPrimaryHeaderBytes || (stream_.begins(at) && is_known(at) && stream_.packet(at) == 0);
  }
  // From which places known packets, one behind the other, lead to the end.
  std::vector<bool> reaching() const {
    std::vector<bool> reaches(end_ - begin_ + 1);
    for (std::size_t at = end_ + 1; at-- > begin_;) {
      const std::size_t size = at < end_ ? stream_.packet(at) : 0;
      const bool led = size > 0 && at + size <= end_ && is_known(at) && reaches[at + size - begin_];
      reaches[at - begin_] = led || is_end(at);
    }
    return reaches;
  }

  const Stream& stream_;
  const Applications& believed_;
  std::size_t begin_, end_;
};

Places places_by_check_sums(const Stream& stream) {
  const Applications believed = believed_applications(stream);
  std::map<Application, Met> ignored;
  const Places right = checked_places(stream, &believed, ignored);
  Places places;
  for (const PacketPlace& place : right) {
    Room(stream, believed, end_of(places), place.offset).fill(places);
    places.push_back(place);
  }
  if (!right.empty()) Room(stream, believed, end_of(places), stream.size()).fill(places);
  return places;
}

// Most packets are of applications that come more than once: what is taken for a header by chance has any of 2^12.
bool is_likely(const Stream& stream, const Places& places) {
  Applications applications;
  for (const PacketPlace& place : places) applications.insert(stream.application(place.offset));
  return places.size() >= 2 && 2 * applications.size() <= places.size();
}

struct Prefix {
  std::size_t head = 0, bytes = 0;
};

// Where the chain begins that covers most bytes; from the end on, each place adds its packet to the chain behind it.
std::size_t best_head(const Stream& stream, std::size_t prefix) {
  const std::size_t tried = std::min(stream.size(), kTriedBytes);
  std::vector<std::size_t> bytes(tried + 1, 0);
  for (std::size_t at = tried; at-- > 0;) {
    const std::size_t size = stream.packet(at);
    if (size > 0 && at + size <= tried) bytes[at] = size + bytes[std::min(at + size + prefix, tried)];
  }
  return static_cast<std::size_t>(std::max_element(bytes.begin(), bytes.end()) - bytes.begin());
}

// How many packets have the count behind the one of their application before: what a chain by chance does not have.
std::size_t counted_on(const Stream& stream, const Places& places) {
  std::map<Application, std::uint16_t> last;
  std::size_t found = 0;
  for (const PacketPlace& place : places) {
    const auto [entry, first] = last.try_emplace(stream.application(place.offset), stream.count(place.offset));
    if (!first && ((entry->second + 1) & kSequenceCountMask) == stream.count(place.offset)) ++found;
    entry->second = stream.count(place.offset);
  }
  return found;
}

Prefix likely_prefix(const Stream& stream) {
  Prefix best;
  std::pair<std::size_t, std::size_t> most{0, 0};
  for (std::size_t bytes = 0; bytes <= kLongestPrefix; ++bytes) {
    std::vector<std::size_t> heads{best_head(stream, bytes)};
    for (std::size_t head = 0; head < std::min(kShortHeads, stream.size()); ++head) heads.push_back(head);
    for (const std::size_t head : heads) {
      const Places places = stream.chain(head, bytes, std::min(stream.size(), head + kTriedBytes));
      const std::pair score{counted_on(stream, places), covered(places)};
      if (score <= most || !is_likely(stream, places)) continue;
      most = score;
      best = {head, bytes};
    }
  }
  return best;
}

Applications repeated_applications(const Stream& stream, const Places& places) {
  Applications once, repeated;
  for (const PacketPlace& place : places) {
    const Application application = stream.application(place.offset);
    if (!once.insert(application).second) repeated.insert(application);
  }
  return repeated;
}

// Packets of known applications, each behind its prefix, by the lengths alone.
class LengthWalk {
 public:
  LengthWalk(const Stream& stream, const Applications& known, std::size_t prefix) : stream_(stream), known_(known), prefix_(prefix) {}

  Places walk() const {
    Places places;
    for (std::size_t at = chain_from(0, stream_.size()); at < stream_.size();) {
      const std::size_t size = stream_.packet(at);
      const std::size_t end = at + size;
      const bool leads_on = size > 0 && leads(end + prefix_);
      const std::size_t inside = leads_on ? end : chain_from(at + 1, end);
      if (inside < end) {  // its end is missing: others begin before it
        at = inside;
        continue;
      }
      if (size > 0) places.push_back({at, size});
      at = leads_on ? end + prefix_ : chain_from(std::max(end, at + 1), stream_.size());
    }
    return places;
  }

 private:
  bool begins_known(std::size_t at) const { return stream_.begins(at) && known_.count(stream_.application(at)) > 0; }
  // To a known header, at once or behind one other packet, or to the end.
  bool leads(std::size_t at) const {
    if (at >= stream_.size() || begins_known(at)) return true;
    const std::size_t next = at + stream_.packet(at) + prefix_;
    return stream_.packet(at) > 0 && next < stream_.size() && begins_known(next);
  }
  // Whether three known packets follow each other here, or fewer up to the end.
  bool is_chain(std::size_t at) const {
    for (int i = 0; i < 3 && at < stream_.size(); ++i) {
      if (!begins_known(at) || stream_.packet(at) == 0) return false;
      at += stream_.packet(at) + prefix_;
    }
    return true;
  }
  std::size_t chain_from(std::size_t begin, std::size_t end) const {
    while (begin < end && !is_chain(begin)) ++begin;
    return begin;
  }

  const Stream& stream_;
  const Applications& known_;
  std::size_t prefix_;
};

Places places_by_lengths(const Stream& stream) {
  const Prefix prefix = likely_prefix(stream);
  const Places places = stream.chain(prefix.head, prefix.bytes, stream.size());
  if (!is_likely(stream, places)) return {};
  return LengthWalk(stream, repeated_applications(stream, places), prefix.bytes).walk();
}

}  // namespace

std::vector<PacketPlace> packet_places(ConstBytes bytes, const StreamCrc& crc) {
  const Stream stream(bytes, crc);
  Places whole = stream.chain(0, 0, stream.size());
  if (!whole.empty() && stream.size() - end_of(whole) < kPrimaryHeaderBytes) return whole;
  Places checked = places_by_check_sums(stream);
  if (2 * covered(checked) > stream.size()) return checked;
  Places chained = places_by_lengths(stream);
  return counted_on(stream, chained) > counted_on(stream, checked) ? chained : checked;
}

}  // namespace lasso::mdat
