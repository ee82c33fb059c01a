#include "bsp/bare/bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::bare {
namespace {

using Octets = std::vector<std::uint8_t>;
constexpr std::size_t kAll = 128, kMost = 70;

Octets random_octets(test::Generator& chance) {
  Octets all(kAll);
  for (std::uint8_t& octet : all) octet = static_cast<std::uint8_t>(chance.bits());
  return all;
}

// All addresses modulo a word and more, all sizes around the blocks; what lies beside stays as it is.
TEST(BoardBytes, CopiesAtAnyAddress) {
  VERIFIES("LASSO-PLT-011~1");
  test::Generator chance(1);
  const Octets from = random_octets(chance);
  const Octets before = random_octets(chance);
  for (std::size_t count = 0; count < kMost; ++count) {
    for (std::size_t at = 0; at < 25; ++at) {
      Octets to = before, expected = before;
      copy_up(to.data() + at / 5, from.data() + at % 5, count);
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at % 5), count, expected.begin() + static_cast<std::ptrdiff_t>(at / 5));
      ASSERT_EQ(to, expected) << count << ' ' << at;
    }
  }
}

TEST(BoardBytes, MovesWhatOverlaps) {
  VERIFIES("LASSO-PLT-011~1");
  test::Generator chance(2);
  const Octets before = random_octets(chance);
  for (std::size_t count = 0; count < kMost; ++count) {
    for (std::size_t to = 0; to < 40; ++to) {
      Octets moved = before, expected = before;
      move(moved.data() + to, moved.data() + 20, count);
      std::copy_n(before.begin() + 20, count, expected.begin() + static_cast<std::ptrdiff_t>(to));
      ASSERT_EQ(moved, expected) << count << ' ' << to;
    }
  }
}

TEST(BoardBytes, FillsAtAnyAddress) {
  VERIFIES("LASSO-PLT-011~1");
  test::Generator chance(3);
  const Octets before = random_octets(chance);
  for (std::size_t count = 0; count < kMost; ++count) {
    for (std::size_t at = 0; at < 5; ++at) {
      Octets filled = before, expected = before;
      fill(filled.data() + at, 0xA7, count);
      std::fill_n(expected.begin() + static_cast<std::ptrdiff_t>(at), count, std::uint8_t{0xA7});
      ASSERT_EQ(filled, expected) << count << ' ' << at;
    }
  }
}

TEST(BoardBytes, ComparesByTheFirstByteThatDiffers) {
  VERIFIES("LASSO-PLT-011~1");
  const std::uint8_t a[] = {1, 2, 3, 0xFF}, b[] = {1, 2, 4, 0};
  EXPECT_EQ(compare(a, b, 2), 0);
  EXPECT_LT(compare(a, b, 4), 0);
  EXPECT_GT(compare(b, a, 4), 0);
  EXPECT_GT(compare(a + 3, b + 3, 1), 0);  // without a sign
}

}  // namespace
}  // namespace lasso::bare
