#include "hal_lcs/frame_reader.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

constexpr std::size_t kRing = 256;

// A device that fills the ring whenever it has room: what is read ends with the budget, not with the bytes.
TEST(LcsFrameReader, ALineThatNeverFallsSilentIsLeftAfterARingsBytes) {
  VERIFIES("LASSO-LCS-004~1");
  const FrameBytes one = encode_frame(1, 2, ConstBytes());
  ByteRing<kRing> ring;
  std::size_t given = 0;
  const auto babble = [&] {
    while (ring.room() >= one.size) given += ring.write(one.span());
  };
  FrameReader<kRing> reader(ring);
  Frame frame;
  babble();
  EXPECT_FALSE(reader.read(frame)) << "without a budget nothing is read";
  for (std::size_t call = 1; call <= 3; ++call) {
    reader.renew_budget();
    std::size_t frames = 0;
    for (; frames < 10 * kRing && reader.read(frame); ++frames) babble();
    EXPECT_LE(frames, kRing / one.size + 1);
    EXPECT_EQ(given - (kRing - ring.room()), call * kRing);
  }
  EXPECT_EQ(reader.counters().frames, 3 * kRing / one.size) << "none is lost from one call to the next";
}

}  // namespace
}  // namespace lasso::lcs
