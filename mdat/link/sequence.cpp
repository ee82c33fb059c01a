#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "mdat/link/headers.hpp"
#include "mdat/link/packet_places.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint32_t kHalfOfCounts = kSequenceCountMask / 2;
constexpr std::size_t kMostCopies = 1000;  // looked at: more are a restart

// The packets of one type and APID, in the order of the stream.
class SequenceWalk {
 public:
  SequenceWalk(ConstBytes stream, std::vector<HeaderLine>& lines, const std::vector<std::size_t>& own)
      : stream_(stream), lines_(lines), own_(own) {}

  void walk() {
    begin(0);
    for (std::size_t i = 1; i < own_.size(); ++i) {
      const std::uint32_t ahead = distance(latest_, count(i));
      const bool damaged = line(i).checksum == Checksum::kWrong && (ahead == 0 || ahead > kFarAhead);
      if (damaged) continue;
      if (ahead == 0) {
        line(i).step = SequenceStep::kRepeated;
      } else if (ahead <= kHalfOfCounts) {
        go_on(i, ahead);
      } else if (is_late(i)) {
        fill_gap(i);
      } else {
        i = go_back(i);
      }
    }
  }

 private:
  struct Seen {
    std::size_t line = 0;
    std::size_t gap = 0;  // the line before which the packet was missing; its own: it was not
  };

  HeaderLine& line(std::size_t i) { return lines_[own_[i]]; }
  std::uint32_t count(std::size_t i) const { return lines_[own_[i]].header.sequence_count; }
  static std::uint32_t distance(std::uint64_t from, std::uint64_t to) { return static_cast<std::uint32_t>(to - from) & kSequenceCountMask; }

  // Counts since here are unwrapped: the first is itself, later ones grow.
  void begin(std::size_t i) {
    first_ = latest_ = count(i);
    seen_.clear();
    seen_[latest_] = {own_[i], own_[i]};
  }
  void restart(std::size_t i) {
    line(i).step = SequenceStep::kRestart;
    begin(i);
  }
  void go_on(std::size_t i, std::uint32_t ahead) {
    if (count(i) == 0 && ahead > kFarAhead) return restart(i);
    line(i).missing = ahead - 1;
    latest_ += ahead;
    seen_[latest_] = {own_[i], own_[i]};
  }
  // The unwrapped count of a packet that is not ahead; less than `first_`: of no packet since the restart.
  std::uint64_t unwrapped(std::size_t i) const {
    const std::uint64_t back = distance(count(i), latest_);
    return back <= latest_ ? latest_ - back : 0;
  }
  bool is_before_first(std::size_t i) const { return distance(count(i), latest_) > latest_ - first_; }
  bool is_late(std::size_t i) const { return !is_before_first(i) && seen_.count(unwrapped(i)) == 0; }
  void fill_gap(std::size_t i) {
    const std::size_t gap = seen_.upper_bound(unwrapped(i))->second.gap;
    line(i).step = SequenceStep::kLate;
    --lines_[gap].missing;
    seen_[unwrapped(i)] = {own_[i], gap};
  }
  bool has_bytes_seen(std::size_t i) {
    const auto found = is_before_first(i) ? seen_.end() : seen_.find(unwrapped(i));
    if (found == seen_.end()) return false;
    const HeaderLine& before = lines_[found->second.line];
    return before.size == line(i).size && std::memcmp(stream_.data() + before.offset, stream_.data() + line(i).offset, before.size) == 0;
  }
  // From i on: packets that were there before, byte for byte.
  std::size_t end_of_copies(std::size_t i) {
    const std::size_t most = std::min(own_.size(), i + kMostCopies);
    while (i < most && has_bytes_seen(i)) ++i;
    return i;
  }
  // The last of the packets from i on that are settled: copies, one that is out of order, or the first behind a restart.
  std::size_t go_back(std::size_t i) {
    const std::size_t end = count(i) == 0 ? i : end_of_copies(i);
    const bool copies = end > i && (end < own_.size() ? is_next(latest_, end) : end == i + 1);
    if (copies || !begins_anew(i)) {
      const std::size_t last = copies ? end - 1 : i;
      const SequenceStep step = is_before_first(i) ? SequenceStep::kLate : SequenceStep::kRepeated;
      for (std::size_t k = i; k <= last; ++k) line(k).step = step;
      return last;
    }
    restart(i);
    return i;
  }
  bool is_next(std::uint64_t from, std::size_t i) const {
    const std::uint32_t ahead = distance(from, count(i));
    return ahead > 0 && ahead <= kHalfOfCounts;
  }
  // The next count goes on from this one rather than from the latest; of the last packet, it is 0.
  bool begins_anew(std::size_t i) const {
    if (i + 1 == own_.size()) return count(i) == 0;
    if (is_swapped(i)) return true;
    return is_next(count(i), i + 1) && distance(count(i), count(i + 1)) < distance(latest_, count(i + 1));
  }
  // Three in a row, of which the first two have changed places: 1, 0, 2.
  bool is_swapped(std::size_t i) const {
    if (i + 2 >= own_.size() || is_next(latest_, i + 2)) return false;
    return distance(count(i + 1), count(i)) == 1 && distance(count(i), count(i + 2)) == 1;
  }

  ConstBytes stream_;
  std::vector<HeaderLine>& lines_;
  const std::vector<std::size_t>& own_;
  std::uint64_t first_ = 0, latest_ = 0;
  std::map<std::uint64_t, Seen> seen_;
};

}  // namespace

void follow_sequences(ConstBytes stream, std::vector<HeaderLine>& lines) {
  std::map<std::pair<PacketType, std::uint16_t>, std::vector<std::size_t>> applications;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].header.apid == kIdleApid) {
      lines[i].step = SequenceStep::kIdle;
    } else {
      applications[{lines[i].header.type, lines[i].header.apid}].push_back(i);
    }
  }
  for (const auto& [application, own] : applications) SequenceWalk(stream, lines, own).walk();
}

}  // namespace lasso::mdat
