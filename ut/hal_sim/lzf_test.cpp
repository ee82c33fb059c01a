#include "hal_sim/lzf.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

std::string unpacked(const std::string& packed, std::size_t size) {
  std::string bytes;
  return unpack_lzf(packed, size, bytes) ? bytes : "refused";
}

TEST(Lzf, UnpacksBytesAndCopies) {
  VERIFIES("LASSO-SIM-020~2");
  EXPECT_EQ(unpacked("\x02"
                     "abc",
                     3),
            "abc");
  EXPECT_EQ(unpacked(std::string("\x02"
                                 "abc\xE0\0\x02",
                                 7),
                     12),
            "abcabcabcabc")
      << "nine bytes from three back";
  EXPECT_EQ(unpacked(std::string("\x01xy\x20\x01", 5), 5), "xyxyx") << "three from two back";
  const std::string far = unpacked(std::string("\0z\xE0\xFF\0\xE0\xFF\0\x01pq\x21\x07", 13), 1 + 264 + 264 + 2 + 3);
  EXPECT_EQ(far, std::string(529, 'z') + "pqzzz") << "from 264 back";
  EXPECT_EQ(unpacked("", 0), "");
}

TEST(Lzf, RefusesWhatIsNone) {
  VERIFIES("LASSO-SIM-021~1");
  EXPECT_EQ(unpacked("\x02"
                     "ab",
                     3),
            "refused")
      << "ends within the bytes";
  EXPECT_EQ(unpacked("\x02"
                     "abc",
                     4),
            "refused")
      << "too few";
  EXPECT_EQ(unpacked("\x02"
                     "abc",
                     2),
            "refused")
      << "too many";
  EXPECT_EQ(unpacked(std::string("\x01xy\x20\x02", 5), 5), "refused") << "from before the begin";
  EXPECT_EQ(unpacked(std::string("\x01xy\xE0", 4), 9), "refused") << "ends within a copy";
  EXPECT_EQ(unpacked(std::string("\x01xy\x20", 4), 5), "refused");
}

}  // namespace
}  // namespace lasso::sim
