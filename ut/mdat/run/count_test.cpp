#include "mdat/common/count.hpp"

#include <gtest/gtest.h>

namespace lasso::mdat {
namespace {

std::string refusal(const std::string& text, std::uint32_t least) {
  try {
    return std::to_string(count_of<std::uint32_t>("cut", text, least));
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Count, ReadsDigits) {
  EXPECT_EQ(refusal("0", 0), "0");
  EXPECT_EQ(refusal("4294967295", 1), "4294967295");
}

TEST(Count, SaysWhatIsNeeded) {
  for (const char* text : {"abc", "", "-1", "3x", " 3", "4294967296", "0x10", "1.5"})
    EXPECT_EQ(refusal(text, 0), std::string("cut=") + text + ": a whole number from 0 to 4294967295 is needed");
  EXPECT_EQ(refusal("0", 1), "cut=0: a whole number from 1 to 4294967295 is needed");
}

}  // namespace
}  // namespace lasso::mdat
