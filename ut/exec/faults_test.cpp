#include "fsw/exec/faults.hpp"

#include <string>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

FaultSet only(Fault fault) {
  FaultSet set;
  set.add(fault);
  return set;
}

TEST(FaultTable, HasARowForEachFaultAtItsNumber) {
  VERIFIES("LASSO-HLT-001~1");
  ASSERT_EQ(fault_table().size(), kFaults);
  for (std::size_t i = 0; i < kFaults; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(fault_table()[i].fault), i);
    EXPECT_GE(fault_table()[i].confirm_frames, 1) << i;
  }
}

TEST(FaultTable, NamesItsReactions) {
  VERIFIES("LASSO-HLT-001~1");
  EXPECT_EQ(std::string(to_string(FaultReaction::kReport)), "report");
  EXPECT_EQ(std::string(to_string(FaultReaction::kMakeSafe)), "make_safe");
  EXPECT_EQ(std::string(to_string(static_cast<FaultReaction>(3))), "unknown");
}

TEST(FaultSets, AreAddedToAndTakenFrom) {
  VERIFIES("LASSO-HLT-001~1");
  FaultSet set;
  EXPECT_TRUE(set.empty());
  set.add(Fault::kSlotSlip);
  set.add(Fault::kTimeJump, false);
  FaultSet others;
  others.add(Fault::kSelfTestFailed);
  set.add(others);
  EXPECT_TRUE(set.has(Fault::kSlotSlip));
  EXPECT_FALSE(set.has(Fault::kTimeJump));
  EXPECT_EQ(set.bits(), (1u << 7) | (1u << 21));
  set.remove(Fault::kSlotSlip);
  EXPECT_EQ(set.bits(), 1u << 21);
}

// Each row alone: confirmed in the frame that its count names, answered once, cleared in the frame that its count names.
TEST(FaultMonitor, ExecutesEachRowAsWritten) {
  VERIFIES("LASSO-HLT-001~1 LASSO-SYS-025~2");
  for (const FaultRow& row : fault_table()) {
    FaultMonitor monitor;
    for (int i = 1; i < row.confirm_frames; ++i) EXPECT_TRUE(monitor.step(only(row.fault)).confirmed.empty());
    const FaultChanges confirmed = monitor.step(only(row.fault));
    EXPECT_EQ(confirmed.confirmed.bits(), only(row.fault).bits());
    EXPECT_EQ(confirmed.reaction, row.reaction);
    EXPECT_TRUE(monitor.active().has(row.fault));
    const FaultChanges again = monitor.step(only(row.fault));
    EXPECT_TRUE(again.confirmed.empty());
    EXPECT_EQ(again.reaction, FaultReaction::kReport);
    int frames = 1;
    while (frames < 600 && monitor.step(FaultSet()).cleared.empty()) ++frames;
    EXPECT_EQ(frames, row.clear_frames > 0 ? row.clear_frames : 600);
    EXPECT_EQ(monitor.active().has(row.fault), row.clear_frames == 0);
    EXPECT_TRUE(monitor.ever().has(row.fault));
    EXPECT_EQ(monitor.confirmations(), 1u);
  }
}

// Any bit, after any number of the frames that confirm the fault: at most those frames are counted once more.
TEST(FaultMonitor, AFlippedBitOfACountPutsAFaultOffByItsConfirmationAtMost) {
  VERIFIES("LASSO-HLT-014~3");
  for (const FaultRow& row : fault_table()) {
    for (int before = 0; before < row.confirm_frames; ++before) {
      for (unsigned bit = 0; bit < 8; ++bit) {
        FaultMonitor monitor;
        auto& count = reinterpret_cast<std::uint8_t*>(&monitor)[static_cast<std::size_t>(row.fault)];
        for (int i = 0; i < before; ++i) ASSERT_TRUE(monitor.step(only(row.fault)).confirmed.empty());
        ASSERT_EQ(count, before) << "the count of this fault";
        count = static_cast<std::uint8_t>(count ^ 1u << bit);
        int frames = 1;
        while (frames < 300 && monitor.step(only(row.fault)).confirmed.empty()) ++frames;
        EXPECT_LE(frames, row.confirm_frames) << static_cast<int>(row.fault) << " " << before << " " << bit;
      }
    }
  }
}

TEST(FaultMonitor, AFrameWithoutTheFaultBeginsTheCountAnew) {
  VERIFIES("LASSO-HLT-001~1");
  FaultMonitor monitor;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(monitor.step(only(Fault::kSensorSilent)).confirmed.empty());
    EXPECT_TRUE(monitor.step(FaultSet()).confirmed.empty());
  }
  EXPECT_TRUE(monitor.active().empty());
}

TEST(FaultMonitor, OfSeveralReactionsTheHeaviestIsGiven) {
  VERIFIES("LASSO-HLT-001~1");
  FaultSet seen = only(Fault::kModeLost);
  seen.add(Fault::kTimeJump);
  seen.add(Fault::kSlotSlip);
  FaultMonitor monitor;
  EXPECT_EQ(monitor.step(seen).reaction, FaultReaction::kMakeSafe);
}

// Against a count of its own, written down the long way, over random frames.
TEST(FaultMonitor, AgreesWithABookKeptByHand) {
  VERIFIES("LASSO-HLT-001~1");
  test::Generator generator(20261122);
  FaultMonitor monitor;
  std::vector<bool> history[kFaults];
  bool active[kFaults] = {};
  for (int frame = 0; frame < 4000; ++frame) {
    FaultSet seen;
    for (std::size_t i = 0; i < kFaults; ++i) {
      history[i].push_back(generator.uniform(0, 1) < 0.6);
      seen.add(fault_table()[i].fault, history[i].back());
    }
    monitor.step(seen);
    for (std::size_t i = 0; i < kFaults; ++i) {
      const FaultRow& row = fault_table()[i];
      const std::size_t wanted = active[i] ? row.clear_frames : row.confirm_frames;
      std::size_t run = 0;
      while (run < history[i].size() && history[i][history[i].size() - 1 - run] != active[i]) ++run;
      if (wanted == 0 || run < wanted) continue;
      active[i] = !active[i];
      history[i].clear();
    }
    for (std::size_t i = 0; i < kFaults; ++i) ASSERT_EQ(monitor.active().has(fault_table()[i].fault), active[i]) << frame << " " << i;
  }
}

}  // namespace
}  // namespace lasso
