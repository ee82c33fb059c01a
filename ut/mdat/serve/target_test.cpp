#include "mdat/serve/target.hpp"

#include <gtest/gtest.h>

#include "hal_sim/random.hpp"
#include "mdat/serve/http.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

TEST(Target, PathAndQueryAreDecoded) {
  VERIFIES("LASSO-WEB-008~1");
  const std::optional<Target> target = parse_target("/api/a%20b//c/?x=1+2&y=%C3%A9&x=3&empty&z=a=b#part");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/api/a b//c/");
  EXPECT_EQ(target->parts, (std::vector<std::string>{"api", "a b", "c"}));
  EXPECT_EQ(text_in(*target, "x"), "3");
  EXPECT_EQ(text_in(*target, "y"), "\xc3\xa9");
  EXPECT_EQ(text_in(*target, "z"), "a=b");
  EXPECT_EQ(text_in(*target, "other"), "");
  EXPECT_EQ(parse_target("/?a=1+2")->query.at("a"), "1 2");
}

TEST(Target, WhatIsNoAddressOfHereIsRefused) {
  VERIFIES("LASSO-WEB-004~1 LASSO-WEB-005~2");
  for (const char* text : {"",
                           "api",
                           "http://elsewhere/",
                           "*",
                           "/..",
                           "/a/../b",
                           "/a/%2e%2e/b",
                           "/a/.",
                           "/%2E",
                           "/a%2F..%2Fb",
                           "/a\\b",
                           "/a%5cb",
                           "/%",
                           "/%1",
                           "/%zz",
                           "/a%00b",
                           "/a\nb",
                           "/?a=%0d%0aSet-Cookie",
                           "/%ff",
                           "/%c0%af",
                           "/%ed%a0",
                           "/?%80=1",
                           "/\x7f"})
    EXPECT_FALSE(parse_target(text)) << text;
  EXPECT_FALSE(parse_target("/" + std::string(kMaxTargetBytes, 'a')));
  EXPECT_TRUE(parse_target("/" + std::string(kMaxTargetBytes - 1, 'a')));
}

// Whatever bytes come: no part leads upwards, or holds a slash that was written as %2f next to dots.
TEST(Target, NoBytesLeadOutOfAFolder) {
  VERIFIES("LASSO-WEB-005~2");
  sim::Random random(11);
  constexpr std::string_view kLetters("/.%2fFeE5c\\?&=+ab\0\xff", 20);
  int parsed = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = "/";
    for (std::uint64_t i = random.bits() % 24; i > 0; --i) text += kLetters[random.bits() % kLetters.size()];
    const std::optional<Target> target = parse_target(text);
    if (!target) continue;
    ++parsed;
    for (const std::string& part : target->parts) {
      EXPECT_TRUE(!part.empty() && part != "." && part != "..") << text;
      EXPECT_EQ(part.find_first_of(std::string_view("/\\\0", 3)), std::string::npos) << text;
    }
  }
  EXPECT_GT(parsed, 1000);
}

TEST(Target, ValuesThatAreNoneAreRefusedByName) {
  VERIFIES("LASSO-WEB-004~1");
  const Target target = parse_target("/?a=1e400&b=nan&c=-1&d=12&e=1.5&f=3x&l=a,,b").value();
  for (const char* name : {"a", "b", "f"}) EXPECT_THROW((void)number_in(target, name, 0), Refusal) << name;
  for (const char* name : {"c", "e", "f"}) EXPECT_THROW((void)count_in(target, name, 0, 100), Refusal) << name;
  EXPECT_THROW((void)count_in(target, "d", 0, 11), Refusal);
  EXPECT_EQ(count_in(target, "d", 0, 12), 12U);
  EXPECT_EQ(number_in(target, "e", 0), 1.5);
  EXPECT_EQ(number_in(target, "not_there", 8), 8);
  EXPECT_EQ(list_in(target, "l"), (std::vector<std::string>{"a", "", "b"}));
  try {
    (void)number_in(target, "f", 0);
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.status, 400U);
    EXPECT_NE(refusal.what.find("f=3x"), std::string::npos);
  }
}

}  // namespace
}  // namespace lasso::mdat::serve
