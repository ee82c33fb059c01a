// What the component tries before it begins: that the processor computes as the component was verified, and that the code of its checks
// works.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

enum class SelfTest : std::uint8_t {
  kRounding = 0,    // double arithmetic rounds to nearest, even
  kSubnormals = 1,  // and keeps subnormal numbers
  kElementary = 2,  // square root, sine, cosine, arc tangent have their known bits
  kCrc16 = 3,       // of packets: the published check value
  kCrc32c = 4,      // of the image and parameters: the published check value
  kCodec = 5,       // big-endian bytes there and back
};

// A bit a test that failed: 1 << number. 0: all passed.
std::uint32_t failed_self_tests();

// Two numbers that must be one: what a test computed, and what is known.
struct KnownAnswer {
  SelfTest test;
  std::uint64_t computed, known;
};
std::uint32_t failed_among(Span<const KnownAnswer> answers);

}  // namespace lasso
