#include "fsw/link/housekeeping.hpp"

#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Frame by frame: sent or not.
std::string story(Housekeeping& housekeeping, std::uint16_t structure, int frames, bool news) {
  std::string sent;
  for (int frame = 0; frame < frames; ++frame) {
    sent += housekeeping.due(structure, news) ? '1' : '0';
    housekeeping.pass_boundary();
  }
  return sent;
}

TEST(Housekeeping, PresetsAreEachPoseAndLinkWhenItHasNews) {
  VERIFIES("LASSO-LNK-014~1");
  Housekeeping housekeeping;
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 3, false), "111");
  EXPECT_EQ(story(housekeeping, kLinkStructureId, 3, false), "000");
  EXPECT_EQ(story(housekeeping, kLinkStructureId, 3, true), "111");
  EXPECT_EQ(story(housekeeping, kFilterStructureId, 3, true), "000") << "on request alone";
}

TEST(Housekeeping, APeriodIsKept) {
  VERIFIES("LASSO-LNK-014~1");
  Housekeeping housekeeping;
  EXPECT_TRUE(housekeeping.set_period(kPoseStructureId, 3));
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 8, true), "10010010");
  EXPECT_TRUE(housekeeping.set_period(kPoseStructureId, 0xFFFF));
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 0x10003, true).find('1'), std::size_t{0xFFFF - 2});
}

TEST(Housekeeping, WhatIsDisabledIsSentWhenAskedForAlone) {
  VERIFIES("LASSO-LNK-014~1");
  Housekeeping housekeeping;
  EXPECT_TRUE(housekeeping.set_enabled(kPoseStructureId, false));
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 3, true), "000");
  EXPECT_TRUE(housekeeping.ask(kPoseStructureId));
  EXPECT_TRUE(housekeeping.asked(kPoseStructureId));
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 3, true), "100");
  EXPECT_FALSE(housekeeping.asked(kPoseStructureId));
  EXPECT_TRUE(housekeeping.set_enabled(kPoseStructureId, true));
  EXPECT_EQ(story(housekeeping, kPoseStructureId, 3, true), "111");
}

TEST(Housekeeping, KnowsItsStructures) {
  VERIFIES("LASSO-LNK-014~1");
  Housekeeping housekeeping;
  for (const std::uint16_t none : {std::uint16_t{0}, static_cast<std::uint16_t>(kStructures)}) {
    EXPECT_FALSE(housekeeping.set_enabled(none, true));
    EXPECT_FALSE(housekeeping.set_period(none, 1));
    EXPECT_FALSE(housekeeping.ask(none));
  }
}

}  // namespace
}  // namespace lasso
