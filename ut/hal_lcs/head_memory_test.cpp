// Words and frames that two processors share.
#include "hal_lcs/head_memory.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "hal_lcs/messages.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

TEST(SharedFrame, IsWholeOrNone) {
  SharedFrame shared;
  Frame frame;
  EXPECT_FALSE(shared.load(frame)) << "nothing was stored";
  const FrameBytes sent = encode(7, CameraStatus{});
  shared.store(sent);
  ASSERT_TRUE(shared.load(frame));
  EXPECT_EQ(frame.sequence, 7);
  FrameBytes half = encode(8, CameraStatus{});
  half.size /= 2;
  shared.store(half);
  EXPECT_FALSE(shared.load(frame)) << "half of it is the one before";
}

TEST(SharedWord, HasItsHighestByteFirst) {
  VERIFIES("LASSO-LCS-022~2");
  SharedWord word;
  word.store(0x12345678);
  std::uint8_t bytes[4];
  std::memcpy(bytes, &word, sizeof bytes);
  EXPECT_EQ(bytes[0], 0x12);
  EXPECT_EQ(bytes[3], 0x78);
  EXPECT_EQ(word.load(), 0x12345678U);
}

}  // namespace
}  // namespace lasso::lcs
