#include "ft/pil/flips.hpp"

#include "fsw/exec/executive.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::pil {
namespace {

constexpr std::size_t kInstructions = 16;   // that are looked out for
constexpr std::uint32_t kMostReached = 3;   // of them
constexpr std::size_t kSkippedDraws = 100;  // a stream of its own beside those of the host's campaigns

std::uint8_t digit_of(char c) { return static_cast<std::uint8_t>(c <= '9' ? c - '0' : c - 'a' + 10); }

bool inside(std::uint32_t address, const Range& range) { return address - range.address < range.bytes; }
Range from(std::uint32_t address, const Range& range) { return {address, range.address + range.bytes - address}; }

}  // namespace

std::uint32_t Flip::boundary() const { return frame * kSlotsPerFrame + slot; }

Flip draw_flip(std::uint64_t seed, std::uint32_t trial, const Range& code) {
  sim::Random random = sim::ray_stream(seed, trial, kSkippedDraws);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random.uniform() * n); };
  Flip flip;
  flip.trial = trial;
  flip.region = static_cast<Region>(trial % kRegions);
  flip.frame = kFirstFrame + below(kFlipFrames);
  flip.slot = below(kSlotsPerFrame);
  flip.place = random.uniform();
  flip.bit = static_cast<std::uint8_t>(below(8));
  flip.reached = 1 + below(kMostReached);
  for (std::size_t i = 0; i < kInstructions; ++i) flip.instructions.push_back(code.address + 4 * below(code.bytes / 4));
  return flip;
}

std::uint32_t address_in(const std::vector<Range>& ranges, double share) {
  std::uint64_t all = 0;
  for (const Range& range : ranges) all += range.bytes;
  auto left = static_cast<std::uint64_t>(share * static_cast<double>(all));
  for (const Range& range : ranges) {
    if (left < range.bytes) return range.address + static_cast<std::uint32_t>(left);
    left -= range.bytes;
  }
  throw mdat::RunError("a region of the board has no bytes");
}

std::string flip_register(std::string& digits, double place, std::uint8_t bit, std::uint32_t& bit_of_register) {
  const auto number = static_cast<std::uint32_t>(place * (kGeneral + kFloating + kOthers));
  const bool floating = number >= kGeneral && number < kGeneral + kFloating;
  const std::uint32_t at = number < kGeneral ? 4 * number
                           : floating        ? 4 * kGeneral + 8 * (number - kGeneral)
                                             : kNipAt + 4 * (number - kGeneral - kFloating);
  const std::uint32_t bytes = floating ? 8 : 4;
  // The share within the register says which byte.
  const double within = place * (kGeneral + kFloating + kOthers) - number;
  bit_of_register = 8 * static_cast<std::uint32_t>(within * bytes) + bit;
  const std::size_t digit = 2 * std::size_t{at + bytes} - 1 - bit_of_register / 4;
  digits[digit] = "0123456789abcdef"[digit_of(digits[digit]) ^ (1U << bit_of_register % 4)];
  if (number < kGeneral) return "r" + std::to_string(number);
  return floating ? "f" + std::to_string(number - kGeneral) : kOtherNames[number - kGeneral - kFloating];
}

std::uint32_t register_word(const std::string& digits, std::size_t at_byte) {
  return static_cast<std::uint32_t>(std::stoul(digits.substr(2 * at_byte, 8), nullptr, 16));
}

std::vector<Range> live_stacks(std::uint32_t pointer, const Range& acquisition, const Range& estimation, std::uint32_t interrupted) {
  std::vector<Range> live;
  const bool foreground = inside(pointer, acquisition);
  if (foreground) live.push_back(from(pointer, acquisition));
  const std::uint32_t background = foreground ? interrupted : pointer;
  if (inside(background, estimation)) live.push_back(from(background, estimation));
  return live;
}

}  // namespace lasso::pil
