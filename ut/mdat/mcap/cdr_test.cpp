#include "mdat/mcap/cdr.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

// By hand: after the four bytes of the encapsulation each number is at a multiple of its size.
TEST(Cdr, NumbersAreAligned) {
  VERIFIES("LASSO-REC-001~1");
  CdrWriter out;
  out.put(std::uint8_t{1}).put(std::uint32_t{2}).put(std::uint8_t{3}).put(1.0).text("ab").put(std::uint16_t{4});
  const std::string expected(
      "\0\1\0\0"
      "\1\0\0\0"
      "\2\0\0\0"
      "\3\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\xf0\x3f"
      "\3\0\0\0"
      "ab\0\0"
      "\4\0",
      38);
  EXPECT_EQ(out.bytes(), expected);
}

TEST(Cdr, WhatIsWrittenComesBack) {
  VERIFIES("LASSO-REC-001~1");
  CdrWriter out;
  out.put(std::int32_t{-5}).text("sensor").put(std::uint8_t{7}).blob("xyz").put(2.5);
  CdrReader in(out.bytes());
  EXPECT_EQ(in.get<std::int32_t>(), -5);
  EXPECT_EQ(in.text(), "sensor");
  EXPECT_EQ(in.get<std::uint8_t>(), 7);
  EXPECT_EQ(in.blob(), "xyz");
  EXPECT_EQ(in.get<double>(), 2.5);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.get<double>(), 0);
  EXPECT_FALSE(in.ok());
}

TEST(Cdr, AnotherEncapsulationIsNotRead) {
  VERIFIES("LASSO-REC-008~2");
  EXPECT_FALSE(CdrReader(std::string_view("\0\0\0\0\0\0\0\1", 8)).ok());
  EXPECT_FALSE(CdrReader("").ok());
}

}  // namespace
}  // namespace lasso::mdat::mcap
