// What has decayed in memory is found, and repaired where something whole is left.
#include "ut/mission/keeper_fixture.hpp"

namespace lasso {
namespace {

using test::crc_of;
using test::image_of;
using test::KeeperTest;
using test::kSlot_us;
using test::TestImage;

// The medium fails between the two readings of a repair: what was written is right, and the next repair does the rest.
TEST_F(KeeperTest, ARepairThatIsCutShortMakesNothingWorse) {
  VERIFIES("LASSO-IMG-016~2");
  ASSERT_EQ(start().status, Status::kOk);
  const std::vector<std::uint8_t> right = active_bytes();
  buffer(0)[20000] ^= 1;
  const std::vector<std::uint8_t> decayed = active_bytes();
  ASSERT_TRUE(scrub());
  store_.reads_left = (keeper_->active().chunk(20000 / kChunkBytes).size() + 255) / 256 + 2;
  EXPECT_FALSE(keeper_->repair().repaired);
  EXPECT_EQ(active_bytes(), decayed);
  store_.reads_left = test::RamStore::kForEver;
  ASSERT_TRUE(scrub());
  EXPECT_TRUE(keeper_->repair().repaired);
  EXPECT_EQ(active_bytes(), right);
}

// A flip anywhere in either image, or in what was made of them: found within a period, repaired from the store, bit by bit.
TEST_F(KeeperTest, FlipsAreFoundWithinAPeriodAndRepaired) {
  VERIFIES("LASSO-IMG-016~2 LASSO-IMG-017~1 LASSO-HLT-010~3");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  const std::vector<std::uint64_t> right[2] = {buffers_[0], buffers_[1]};
  std::uint32_t seed = 11;
  for (std::uint32_t i = 0; i < 60; ++i) {
    seed = seed * 1664525U + 1013904223U;
    const std::size_t slot = i % 2;
    const ImageSlot& flipped = slot == 0 ? keeper_->active() : keeper_->other();
    const bool view = i % 3 == 0;
    const auto* in_view = reinterpret_cast<const std::uint8_t*>(&flipped.view(0).mission.parameters);
    const auto parameters_at = static_cast<std::size_t>(in_view - flipped.sealed_views().data());
    const ConstBytes area = view ? flipped.sealed_views() : flipped.sealed_image();
    const std::size_t byte = view ? parameters_at + (seed >> 6) % 500 : (seed >> 6) % area.size();
    const_cast<std::uint8_t*>(area.data())[byte] ^= static_cast<std::uint8_t>(1U << (seed >> 3 & 7));
    ASSERT_TRUE(scrub()) << byte;
    const MemoryFinding finding = keeper_->repair();
    EXPECT_TRUE(finding.repaired);
    EXPECT_EQ(finding.area, static_cast<ScrubArea>(2 * slot + (view ? 1 : 0)));
    EXPECT_EQ(finding.chunk, byte / kChunkBytes);
    EXPECT_EQ(buffers_[slot], right[slot]);
  }
  EXPECT_EQ(points(), 512);
  EXPECT_FALSE(scrub());
  EXPECT_GT(keeper_->scrub_pass_us(), 0);
  EXPECT_LE(keeper_->scrub_pass_us(), 10'000'000);
  EXPECT_EQ(keeper_->scrub_state().findings(), 60U);
}

TEST_F(KeeperTest, WhatCannotBeRepairedIsToldAgainAndNotMadeWorse) {
  VERIFIES("LASSO-IMG-016~2 LASSO-IMG-017~1");
  ASSERT_EQ(start().status, Status::kOk);
  store_.of(StoreArea::kImage0)[kStoredHeaderBytes + 20001] ^= 1;  // the store has decayed, too, in the same chunk
  buffer(0)[20000] ^= 1;
  const std::vector<std::uint8_t> before = active_bytes();
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(scrub());
    EXPECT_FALSE(keeper_->repair().repaired);
  }
  EXPECT_EQ(active_bytes(), before);
  store_.broken = true;
  ASSERT_TRUE(scrub());
  EXPECT_FALSE(keeper_->repair().repaired);
  EXPECT_TRUE(keeper_->started());
}

// The other image, without a store: it cannot be made active any more.
TEST_F(KeeperTest, ASpareImageThatHasDecayedIsNoImage) {
  VERIFIES("LASSO-IMG-016~2");
  restart(false);
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  buffer(1)[4000] ^= 0x80;
  ASSERT_TRUE(scrub());
  EXPECT_FALSE(keeper_->repair().repaired);
  EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNotReady);
  EXPECT_EQ(keeper_->other().state(), ImageState::kRefused);
}

TEST_F(KeeperTest, CodeIsWatchedAndReported) {
  VERIFIES("LASSO-IMG-017~1");
  std::vector<std::uint8_t> code(3 * kChunkBytes + 77, 0x60);
  ASSERT_EQ(keeper_->watch_code(ConstBytes(code.data(), code.size())), Status::kOk);
  EXPECT_EQ(keeper_->code().size(), code.size());
  ASSERT_EQ(start().status, Status::kOk);
  EXPECT_FALSE(scrub());
  code[2 * kChunkBytes + 5] ^= 2;
  ASSERT_TRUE(scrub());
  const MemoryFinding finding = keeper_->repair();
  EXPECT_EQ(finding.area, ScrubArea::kCode);
  EXPECT_EQ(finding.chunk, 2U);
  EXPECT_FALSE(finding.repaired);
}

// What the next load overwrites is not looked at any more.
TEST_F(KeeperTest, ALoadIsNoDecay) {
  VERIFIES("LASSO-IMG-017~1");
  ASSERT_EQ(start().status, Status::kOk);
  for (int i = 0; i < 3; ++i) {
    make_ready(new_image());
    EXPECT_FALSE(scrub());
    keeper_->swap();
    keeper_->confirm();
    upload(old_image());
    EXPECT_FALSE(scrub());
    ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
    work();
    keeper_->swap();
    keeper_->confirm();
  }
}

// A load may begin in the middle of what is looked at in the image that it replaces.
TEST_F(KeeperTest, ALoadThatBeginsWhereTheScrubIsIsNoDecay) {
  VERIFIES("LASSO-IMG-017~1");
  ASSERT_EQ(start().status, Status::kOk);
  for (const ScrubArea area : {ScrubArea::kImage1, ScrubArea::kViews0, ScrubArea::kViews1, ScrubArea::kImage0}) {
    make_ready(new_image());
    while (keeper_->scrub_state().area() != area) ASSERT_FALSE(keeper_->scrub(kSlot_us));
    ASSERT_FALSE(keeper_->scrub(kSlot_us));
    upload(old_image());
    EXPECT_FALSE(scrub()) << static_cast<int>(area);
    make_ready(new_image());
    keeper_->swap();
    keeper_->confirm();
  }
}

}  // namespace
}  // namespace lasso
