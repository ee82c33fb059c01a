#include "fsw/exec/executive.hpp"

#include <algorithm>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Executive, SlotsDivideTheFrameWithoutDrift) {
  VERIFIES("LASSO-EXE-001~1");
  Executive executive;
  ASSERT_EQ(executive.begin(1000, 200003), Status::kOk);
  for (std::int64_t n = 0; n < 1000; ++n) {
    const std::int64_t frame = n / 20;
    const std::int64_t slot = n % 20;
    ASSERT_EQ(executive.next_slot_us(), 1000 + frame * 200003 + slot * 200003 / 20);
    ASSERT_EQ(executive.next_slot(), slot);
    ASSERT_EQ(executive.frame(), frame);
    executive.advance();
  }
}

TEST(Executive, KnowsTheNextBoundary) {
  VERIFIES("LASSO-EXE-001~1");
  Executive executive;
  ASSERT_EQ(executive.begin(500, 20000), Status::kOk);
  EXPECT_EQ(executive.next_boundary_us(), 500);
  executive.advance();
  EXPECT_EQ(executive.next_boundary_us(), 20500);
}

TEST(Executive, RefusesSlotsShorterThanItsClock) {
  VERIFIES("LASSO-EXE-001~1");
  Executive executive;
  EXPECT_EQ(executive.begin(0, 19), Status::kBadValue);
  EXPECT_FALSE(executive.begun());
  EXPECT_EQ(executive.begin(0, kLongestFrame_us + 1), Status::kBadValue);
  EXPECT_EQ(executive.begin(0, 20), Status::kOk);
  EXPECT_TRUE(executive.begun());
}

TEST(Executive, ItsPeriodSurvivesAFlip) {
  VERIFIES("LASSO-HLT-014~3");
  constexpr std::uint32_t kCopies[] = {200003, ~200003u, 200003};
  Executive executive;
  ASSERT_EQ(executive.begin(1000, 200003), Status::kOk);
  auto* const words = reinterpret_cast<std::uint32_t*>(&executive);
  auto* const copies = std::search(words, words + sizeof(Executive) / sizeof(std::uint32_t), kCopies, kCopies + 3);
  ASSERT_NE(copies, words + sizeof(Executive) / sizeof(std::uint32_t));
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    copies[bit / 32] ^= 1u << bit % 32;
    EXPECT_EQ(executive.slot_us(), 10000) << bit;
    for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) executive.advance();
    EXPECT_EQ(executive.next_slot_us(), 1000 + (bit + 1) * 200003) << bit;
    EXPECT_TRUE(std::equal(kCopies, kCopies + 3, copies)) << "repaired";
  }
  copies[0] = 7;
  copies[2] = 9;
  EXPECT_FALSE(executive.begun()) << "no two agree: nothing runs, and the watchdog bites";
  EXPECT_FALSE(executive.awaits_begin()) << "a lost period does not pass for one that nobody has set";
}

TEST(Executive, PollsInEverySlotAndPassesTheBoundaryAfterItsPoll) {
  VERIFIES("LASSO-EXE-001~1");
  for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) {
    std::vector<TaskId> order;
    for (const SlotRow& row : slot_table()) {
      if (is_due(row, slot)) order.push_back(row.task);
    }
    std::vector<TaskId> expected{TaskId::kPollSensor};
    if (slot == 0) expected.push_back(TaskId::kPassBoundary);
    expected.push_back(TaskId::kTendMemory);
    EXPECT_EQ(order, expected) << slot;
  }
}

TEST(Executive, BudgetsOfASlotFitIntoIt) {
  VERIFIES("LASSO-EXE-001~1");
  constexpr DurationUs kNominalSlotUs = 10000;
  for (std::uint32_t slot = 0; slot < kSlotsPerFrame; ++slot) {
    DurationUs sum = 0;
    for (const SlotRow& row : slot_table()) sum += is_due(row, slot) ? row.budget_us : 0;
    EXPECT_LE(sum, kNominalSlotUs);
  }
}

TEST(Executive, CountsASlipWhenASlotBeginsLaterThanItsLength) {
  VERIFIES("LASSO-EXE-004~1");
  Executive executive;
  ASSERT_EQ(executive.begin(0, 200000), Status::kOk);
  executive.note_start(10000);
  EXPECT_EQ(executive.slips(), 0u);
  executive.advance();
  executive.note_start(20001);
  EXPECT_EQ(executive.slips(), 1u);
  EXPECT_EQ(executive.worst_lateness_us(), 10001);
  executive.advance();
  executive.note_start(20500);
  EXPECT_EQ(executive.slips(), 1u);
  EXPECT_EQ(executive.worst_lateness_us(), 10001) << "of all";
}

TEST(Executive, AClockFarFromTheNextSlotHasJumped) {
  VERIFIES("LASSO-HLT-006~2");
  Executive executive;
  ASSERT_EQ(executive.begin(60'000'000, 200'000), Status::kOk);
  EXPECT_FALSE(executive.jumped(0)) << "the first slot may be far ahead";
  EXPECT_FALSE(executive.jumped(70'000'000));
  EXPECT_TRUE(executive.jumped(70'000'001)) << "later than ten seconds";
  executive.advance();
  EXPECT_FALSE(executive.jumped(50'010'000));
  EXPECT_TRUE(executive.jumped(50'009'999)) << "earlier than ten seconds";
  EXPECT_EQ(executive.follow_jump(70'000'000), 9'990'000);
  EXPECT_EQ(executive.next_slot_us(), 70'000'000);
  EXPECT_EQ(executive.next_slot(), 1u) << "the same slot of the same frame";
  executive.advance();
  EXPECT_EQ(executive.next_slot_us(), 70'010'000);
}

}  // namespace
}  // namespace lasso
