#include "fsw/core/limit.hpp"

#include <gtest/gtest.h>

TEST(Limit, TakesWhatIsLarger) {
  EXPECT_EQ(larger(3, 5), 5);
  EXPECT_EQ(larger(9, 5), 9);
}

TEST(Limit, EightAreFull) {
  EXPECT_FALSE(is_full(7));
  EXPECT_TRUE(is_full(8));
}

TEST(Limit, Halves) { EXPECT_EQ(half(6), 3); }
