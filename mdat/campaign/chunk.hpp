// A campaign's cases divided among runners.
#pragma once

#include <cstdint>
#include <string>

namespace lasso::mdat {

// One of `of` chunks, counted from 1. Its cases are interleaved (number - 1, number - 1 + of, ...), so that each chunk has cases of all
// kinds.
struct Chunk {
  std::uint32_t number = 1, of = 1;
};

// "3of10": how its files are named.
inline std::string chunk_name(const Chunk& chunk) { return std::to_string(chunk.number) + "of" + std::to_string(chunk.of); }

}  // namespace lasso::mdat
