#include "fsw/exec/watchdog.hpp"

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

void run_slots(CheckIn& check_in, std::uint32_t missing) {
  for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) {
    if (slot != missing) check_in.slot(slot);
  }
}

TEST(CheckIn, AsksForEverySlot) {
  VERIFIES("LASSO-HLT-003~2");
  for (std::uint32_t missing = 0; missing <= kSlotsPerFrame; ++missing) {
    CheckIn check_in;
    EXPECT_TRUE(check_in.boundary(true)) << "nothing has run before the first one";
    run_slots(check_in, missing);
    EXPECT_EQ(check_in.boundary(true), missing == kSlotsPerFrame) << missing;
    run_slots(check_in, kSlotsPerFrame);
    EXPECT_TRUE(check_in.boundary(true)) << "each frame by itself";
  }
}

TEST(CheckIn, AsksForTheEstimationThread) {
  VERIFIES("LASSO-HLT-003~2");
  CheckIn check_in;
  EXPECT_TRUE(check_in.boundary(true));
  for (std::uint32_t busy = 1; busy < 2 * CheckIn::kEstimationFrames; ++busy) {
    run_slots(check_in, kSlotsPerFrame);
    EXPECT_EQ(check_in.boundary(false), busy < CheckIn::kEstimationFrames) << busy;
  }
  run_slots(check_in, kSlotsPerFrame);
  EXPECT_TRUE(check_in.boundary(true));
}

}  // namespace
}  // namespace lasso
