// What a campaign of flips on the target draws: where, and when (docs/pil.md).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ft/pil/seu_board.hpp"
#include "hal_sim/random.hpp"

namespace lasso::pil {

constexpr std::uint32_t kFirstFrame = 6;  // in which flips happen, the track being settled
constexpr std::uint32_t kFlipFrames = 4;  // and the frames after it in which they do

// The first four are protected.
enum class Region : std::uint8_t { kCode = 0, kImage = 1, kViews = 2, kMode = 3, kVectors = 4, kData = 5, kStack = 6, kRegisters = 7 };
constexpr std::uint32_t kRegions = 8;
constexpr std::array<const char*, kRegions> kRegionNames{"code", "image", "views", "mode", "vectors", "data", "stack", "registers"};
constexpr bool within_slot(Region region) { return region == Region::kStack || region == Region::kRegisters; }

struct Flip {
  std::uint32_t trial = 0;
  Region region = Region::kCode;
  std::uint32_t frame = 0, slot = 0;
  double place = 0;  // share of the region, of the live stack, of the registers
  std::uint8_t bit = 0;
  // Within a slot: when the so many-th of these instructions is reached.
  std::vector<std::uint32_t> instructions;
  std::uint32_t reached = 0;
  std::uint32_t boundary() const;
};

// By seed and number alone.
Flip draw_flip(std::uint64_t seed, std::uint32_t trial, const Range& code);

// The address at a share of several ranges.
std::uint32_t address_in(const std::vector<Range>& ranges, double share);

// A register in the digits of the debug port, one of its bits turned over. Its name comes back.
std::string flip_register(std::string& digits, double place, std::uint8_t bit, std::uint32_t& bit_of_register);
std::uint32_t register_word(const std::string& digits, std::size_t at_byte);

// What the stacks hold between their pointers and their ends, of the context that runs and of the one below it.
std::vector<Range> live_stacks(std::uint32_t pointer, const Range& acquisition, const Range& estimation, std::uint32_t interrupted);

}  // namespace lasso::pil
