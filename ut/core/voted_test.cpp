#include "fsw/core/voted.hpp"

#include <cstring>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

enum class Colour : std::uint8_t { kRed = 0, kGreen = 9 };

// `voted` with bit `bit` of its memory flipped.
Voted<Colour> flipped(Voted<Colour> voted, std::size_t bit) {
  std::uint8_t bytes[sizeof(voted)];
  std::memcpy(bytes, &voted, sizeof(voted));
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
  std::memcpy(&voted, bytes, sizeof(voted));
  return voted;
}

TEST(Voted, EverySingleFlipIsOutvotedAndSeen) {
  VERIFIES("LASSO-HLT-004~1");
  for (std::size_t bit = 0; bit < 8 * sizeof(Voted<Colour>); ++bit) {
    const Voted<Colour> voted = flipped(Voted<Colour>(Colour::kGreen), bit);
    Colour value = Colour::kRed;
    EXPECT_TRUE(voted.get(value));
    EXPECT_EQ(value, Colour::kGreen) << bit;
    EXPECT_FALSE(voted.agreed()) << bit;
  }
}

TEST(Voted, TwoDifferentFlipsLeaveNoValue) {
  VERIFIES("LASSO-HLT-004~1");
  Colour value = Colour::kRed;
  EXPECT_FALSE(flipped(flipped(Voted<Colour>(Colour::kGreen), 1), 34).get(value));
  EXPECT_EQ(value, Colour::kRed) << "as it was";
}

TEST(Voted, IsRepairedBySettingIt) {
  VERIFIES("LASSO-HLT-004~1");
  Voted<Colour> voted = flipped(Voted<Colour>(Colour::kGreen), 70);
  Colour value = Colour::kRed;
  ASSERT_TRUE(voted.get(value));
  voted.set(value);
  EXPECT_TRUE(voted.agreed());
  EXPECT_TRUE(voted.get(value));
  EXPECT_EQ(value, Colour::kGreen);
}

// A word that is set to zero, or to ones, twice: the inverted copy stands against it.
TEST(Voted, MemoryThatIsClearedHasNoValueOfItsOwn) {
  VERIFIES("LASSO-HLT-004~1");
  Voted<Colour> voted(Colour::kGreen);
  std::memset(static_cast<void*>(&voted), 0, sizeof(voted));
  EXPECT_FALSE(voted.agreed());
}

}  // namespace
}  // namespace lasso
