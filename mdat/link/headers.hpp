// The headers of any stream of space packets: checksums, and how the sequence counts follow each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fsw/link/space_packet.hpp"

namespace lasso::mdat {

enum class Checksum : std::uint8_t { kRight, kWrong, kNone };

// How a packet's count stands to those of its type and APID before it.
constexpr std::uint32_t kFarAhead = 64;

enum class SequenceStep : std::uint8_t {
  kNext,      // ahead of all, by less than half of all counts; the first of its kind, too
  kRestart,   // the counter began anew here
  kLate,      // a packet that was missing until now, or stands before all since the restart
  kRepeated,  // a count that was there before, after which the sequence goes on
  kIdle,      // fill packets (APID 2047) have no sequence
};

struct HeaderLine {
  std::size_t offset = 0;
  std::size_t size = 0;
  std::size_t skipped = 0;  // bytes before it that are no packet
  PrimaryHeader header;
  Checksum checksum = Checksum::kNone;
  SequenceStep step = SequenceStep::kNext;
  std::uint32_t missing = 0;  // packets of its type and APID between it and those before, that never come
  // More than 64, and 0 among them: the counter may as well have begun anew, with as many missing as it has counted since.
  bool may_be_restart() const { return missing > kFarAhead && missing > header.sequence_count; }
};
struct HeaderList {
  std::vector<HeaderLine> lines;
  std::size_t left_over = 0;  // bytes behind the last packet
};

// The packets of packet_places. A checksum is none where of at least three packets of a type and APID fewer than one in a thousand has a
// right one, and wrong where others have.
HeaderList list_headers(ConstBytes stream);

// Sets `step` and `missing` of all lines. A count that is not ahead is late where it fills a gap since the last restart; repeated where its
// packet, and those behind it, have the bytes of earlier ones and the sequence then goes on, or where the next count goes on from those
// before it (late where it is before the first one since the restart); otherwise the counter began anew. So it did where a count of 0
// stands more than 64 ahead. The count of a packet whose checksum is wrong is believed where it is at most 64 ahead.
void follow_sequences(ConstBytes stream, std::vector<HeaderLine>& lines);

}  // namespace lasso::mdat
