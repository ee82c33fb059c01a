// A chunk of messages, as it lies in the file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lasso::mdat::mcap {

struct ChunkParts {
  std::uint64_t first_ns = 0, last_ns = 0, size = 0;  // unpacked
  std::uint32_t crc = 0;
  std::string_view compression, body;
};

// Of a chunk record's content, which outlives them. False: it is shorter than it says.
bool parts_of(std::string_view content, ChunkParts& parts);

// The records of a chunk. Empty, with a reason, where it cannot be unpacked, or has another checksum than it says.
std::string unpacked(const ChunkParts& parts, std::string& why);

}  // namespace lasso::mdat::mcap
