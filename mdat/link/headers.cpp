#include "mdat/link/headers.hpp"

#include <map>
#include <utility>

#include "mdat/link/packet_places.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kLeastShown = 3;        // packets that show whether theirs have checksums
constexpr std::size_t kRightByChance = 1000;  // one in 65536 is

struct Counted {
  std::size_t packets = 0, right = 0;
};

// Where hardly any is right, there are no checksums.
void judge_checksums(std::vector<HeaderLine>& lines) {
  std::map<std::pair<PacketType, std::uint16_t>, Counted> applications;
  Counted all;
  for (const HeaderLine& line : lines) {
    const std::size_t right = line.checksum == Checksum::kRight ? 1 : 0;
    for (Counted* counted : {&applications[{line.header.type, line.header.apid}], &all}) {
      ++counted->packets;
      counted->right += right;
    }
  }
  for (HeaderLine& line : lines) {
    const Counted& own = applications[{line.header.type, line.header.apid}];
    const bool shown = own.packets >= kLeastShown || (all.right == 0 && all.packets >= kLeastShown);
    const bool none = line.header.apid == kIdleApid || (shown && own.right * kRightByChance < own.packets);
    if (line.checksum == Checksum::kWrong && none) line.checksum = Checksum::kNone;
  }
}

}  // namespace

HeaderList list_headers(ConstBytes stream) {
  const StreamCrc crc(stream);
  HeaderList list;
  std::size_t end = 0;
  for (const PacketPlace& place : packet_places(stream, crc)) {
    HeaderLine line;
    line.offset = place.offset;
    line.size = place.size;
    line.skipped = place.offset - end;
    line.header = read_primary_header(stream.subspan(place.offset, place.size));
    line.checksum = place.size >= kPrimaryHeaderBytes + kPacketTrailerBytes && crc.right(place.offset, place.size) ? Checksum::kRight
                                                                                                                   : Checksum::kWrong;
    list.lines.push_back(line);
    end = place.offset + place.size;
  }
  list.left_over = stream.size() - end;
  judge_checksums(list.lines);
  follow_sequences(stream, list.lines);
  return list;
}

}  // namespace lasso::mdat
