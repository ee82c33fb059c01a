#include "fsw/mission/scrub.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/mission/image_slot.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Memory {
  explicit Memory(std::size_t size) : bytes(size) {
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + i / 251);
    for (std::size_t i = 0; i * kChunkBytes < size; ++i) sums.push_back(crc32c(chunk_of(view(), i)));
  }
  ConstBytes view() const { return {bytes.data(), bytes.size()}; }
  ScrubPlace place() const { return {view(), Span<const std::uint32_t>(sums.data(), sums.size())}; }
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint32_t> sums;
};

class ScrubTest : public ::testing::Test {
 protected:
  bool step(std::size_t bytes) {
    const ScrubPlace places[kScrubAreas] = {image_.place(), views_.place(), {}, {}, code_.place()};
    return scrub_.step(places, bytes);
  }
  std::size_t all() const { return image_.bytes.size() + views_.bytes.size() + code_.bytes.size(); }
  // Steps until something is found, or a pass is over; whether something was.
  bool walk(std::size_t bytes) {
    const std::uint32_t passes = scrub_.passes();
    std::size_t steps = 0;
    while (!step(bytes) && scrub_.passes() == passes) ++steps;
    EXPECT_LE(steps, all() / bytes + 1);
    return scrub_.found();
  }

  Memory image_{3 * kChunkBytes + 100}, views_{5000}, code_{2 * kChunkBytes};
  Scrub scrub_;
};

TEST_F(ScrubTest, WhatIsRightPasses) {
  VERIFIES("LASSO-IMG-017~1");
  for (std::size_t bytes : {1000U, 16384U, 40000U, 1U << 20}) EXPECT_FALSE(walk(bytes)) << bytes;
  EXPECT_EQ(scrub_.findings(), 0U);
  EXPECT_GE(scrub_.passes(), 4U);
}

// Every flip, wherever it is, within a pass from when it happened.
TEST_F(ScrubTest, EveryFlipIsFoundWithinAPass) {
  VERIFIES("LASSO-IMG-017~1 LASSO-HLT-010~3");
  std::uint32_t seed = 4;
  for (int i = 0; i < 300; ++i) {
    seed = seed * 1664525U + 1013904223U;
    Memory& memory = i % 3 == 0 ? image_ : i % 3 == 1 ? views_ : code_;
    const std::size_t byte = (seed >> 5) % memory.bytes.size();
    const auto mask = static_cast<std::uint8_t>(1U << (seed >> 2 & 7));
    for (std::uint32_t k = 0; k < (seed >> 20) % 13; ++k) step(7001);  // it happens anywhere in a pass
    memory.bytes[byte] ^= mask;
    std::size_t walked = 0;
    for (; !step(5000) && walked <= 2 * all(); walked += 5000) {
    }
    EXPECT_TRUE(scrub_.found()) << byte;
    EXPECT_LE(walked, all() + kChunkBytes + 5000);
    EXPECT_EQ(scrub_.area(), i % 3 == 0 ? ScrubArea::kImage0 : i % 3 == 1 ? ScrubArea::kViews0 : ScrubArea::kCode);
    EXPECT_EQ(scrub_.chunk(), byte / kChunkBytes);
    EXPECT_TRUE(step(100000));  // it stands
    memory.bytes[byte] ^= mask;
    scrub_.resume();
  }
  EXPECT_EQ(scrub_.findings(), 300U);
}

TEST_F(ScrubTest, ForgetsWhatIsBeingReplaced) {
  VERIFIES("LASSO-IMG-017~1");
  image_.bytes[5] ^= 1;
  EXPECT_TRUE(walk(1 << 20));
  scrub_.forget(ScrubArea::kCode);  // another one
  EXPECT_TRUE(scrub_.found());
  scrub_.forget(ScrubArea::kImage0);
  EXPECT_FALSE(scrub_.found());
  image_.bytes[5] ^= 1;
  EXPECT_FALSE(walk(1 << 20));
}

TEST(Scrub, OfNothingIsAPassAtOnce) {
  VERIFIES("LASSO-IMG-017~1");
  Scrub scrub;
  const ScrubPlace places[kScrubAreas] = {};
  EXPECT_FALSE(scrub.step(places, 1));
  EXPECT_GE(scrub.passes(), 1U);
}

}  // namespace
}  // namespace lasso
