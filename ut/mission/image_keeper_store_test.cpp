// What the keeper has in its store, and what a start takes of it.
#include "ut/mission/keeper_fixture.hpp"

namespace lasso {
namespace {

using test::crc_of;
using test::image_of;
using test::KeeperTest;
using test::kSlot_us;
using test::TestImage;

TEST_F(KeeperTest, StartsWithTheImageThatWasConfirmedLast) {
  VERIFIES("LASSO-IMG-015~1");
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kNoData);  // a store that was never written
  ASSERT_EQ(start().status, Status::kOk);
  EXPECT_TRUE(keeper_->active_stored());
  make_ready(new_image());
  EXPECT_TRUE(keeper_->other_stored());
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);  // the new one is stored, but was not confirmed
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kNotReady);
  make_ready(new_image());
  keeper_->swap();
  keeper_->confirm();
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 600);
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kNone);
  keeper_->swap();
  keeper_->confirm();
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);
}

TEST_F(KeeperTest, AnImageInTheStoreThatIsWrongGivesWayToTheOneBefore) {
  VERIFIES("LASSO-IMG-015~1 LASSO-IMG-016~2");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  keeper_->swap();
  keeper_->confirm();
  test::RamStore whole = store_;
  store_.of(StoreArea::kImage1)[5000] ^= 1;
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);
  store_.of(StoreArea::kImage0)[7000] ^= 1;
  restart();
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kBadCrc);
  EXPECT_FALSE(keeper_->started());
  store_ = whole;
  store_.broken = true;
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kNoData);
  store_ = whole;
  ASSERT_EQ(write_header(store_, StoreArea::kImage1, {9, 4000, 0}), Status::kOk);  // not the image's length
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);
}

// Power fails behind any of a sample of the bytes that are written from the start of the storing to the confirmation: the next start has
// one of the two images, whole, and the old one until the last header is there.
TEST_F(KeeperTest, APowerLossWhileStoringLeavesTheOldImage) {
  VERIFIES("LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  const test::RamStore before = store_;
  store_.written = 0;
  make_ready(new_image());
  keeper_->swap();
  keeper_->confirm();
  const std::size_t all = store_.written;
  std::vector<std::size_t> cuts(40);
  std::iota(cuts.begin(), cuts.end(), 1);  // the header that is cleared
  for (std::size_t cut = 1000; cut < all; cut += 4099) cuts.push_back(cut);
  for (std::size_t back = 0; back < 70; ++back) cuts.push_back(all - back);  // the headers that are written
  for (const std::size_t cut : cuts) {
    SCOPED_TRACE(cut);
    store_ = before;
    restart();
    ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
    store_.bytes_left = cut;
    make_ready(new_image());
    keeper_->swap();
    keeper_->confirm();
    store_.bytes_left = test::RamStore::kForEver;
    restart();
    ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
    EXPECT_EQ(points(), cut > all - 12 ? 600 : 512);  // the last 12 bytes of a header are of no meaning
  }
}

TEST_F(KeeperTest, AStoreThatFailsStopsNoImage) {
  VERIFIES("LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  store_.broken = true;
  make_ready(new_image());
  EXPECT_FALSE(keeper_->other_stored());
  keeper_->swap();
  keeper_->confirm();
  store_.broken = false;
  // The area of the only image that the next start could take is not written to.
  make_ready(old_image());
  EXPECT_FALSE(keeper_->other_stored());
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);
  store_.of(StoreArea::kImage1).resize(100);  // an area that is too small
  make_ready(new_image());
  EXPECT_FALSE(keeper_->other_stored());
}

// The medium fails in the middle, and at the header.
TEST_F(KeeperTest, AStoreThatFailsInTheMiddleHasNoImage) {
  VERIFIES("LASSO-IMG-015~1");
  for (const std::size_t writes : {2U, 6U}) {
    restart();
    store_ = test::RamStore(old_image().size + 4096);
    ASSERT_EQ(start().status, Status::kOk);
    upload(new_image());
    ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
    const std::size_t last = (new_image().size + kMaxStoreWriteBytes - 1) / kMaxStoreWriteBytes + 2;
    const std::size_t fail = store_.writes + (writes == 2 ? writes : last);
    for (int i = 0; i < 10000 && keeper_->other().state() != ImageState::kReady; ++i) {
      store_.broken = store_.writes + 1 >= fail;
      keeper_->step(1);
    }
    store_.broken = false;
    EXPECT_FALSE(keeper_->other_stored());
    keeper_->swap();
    keeper_->confirm();
    restart();
    ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
    EXPECT_EQ(points(), 512);
  }
}

// The area of the active image cannot hold it: the next start has nothing else, and the new image is stored.
TEST_F(KeeperTest, AnAreaIsWrittenWhereTheOtherOneHoldsNothing) {
  VERIFIES("LASSO-IMG-015~1");
  store_.of(StoreArea::kImage0).resize(100);
  ASSERT_EQ(start().status, Status::kOk);
  EXPECT_FALSE(keeper_->active_stored());
  make_ready(new_image());
  EXPECT_TRUE(keeper_->other_stored());
}

// The image on trial is in the store, too, but a start would take the one before it, though it has decayed in memory.
TEST_F(KeeperTest, AnImageOnTrialDoesNotCostTheStoreWhatAStartWouldTake) {
  VERIFIES("LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  ASSERT_TRUE(keeper_->other_stored());
  keeper_->swap();
  buffer(0)[4000] ^= 4;
  store_.broken = true;  // so that it cannot be repaired
  ASSERT_TRUE(scrub());
  EXPECT_FALSE(keeper_->repair().repaired);
  store_.broken = false;
  make_ready(image_of(700));
  EXPECT_FALSE(keeper_->other_stored());
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(points(), 512);
}

TEST_F(KeeperTest, WhatTheStoreSelectsAnywayIsNotWrittenAgain) {
  VERIFIES("LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  const std::size_t writes = store_.writes;
  keeper_->confirm();
  EXPECT_EQ(store_.writes, writes);
  EXPECT_TRUE(keeper_->active_stored());
}

TEST_F(KeeperTest, NothingIsReadIntoABufferThatIsTooSmall) {
  VERIFIES("LASSO-IMG-011~1 LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  restart();
  ASSERT_EQ(keeper_->use_buffers(buffer(0).first(4096), buffer(1).first(4096)), Status::kOk);
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kNoData);
  EXPECT_FALSE(keeper_->started());
  EXPECT_EQ(buffers_[0], std::vector<std::uint64_t>(buffers_[0].size(), 0x5555555555555555U));
  ASSERT_EQ(start().status, Status::kOk);  // at the buffer's begin, and longer than it: where it lies
  EXPECT_EQ(points(), 512);
  EXPECT_EQ(open(new_image()), ImageRefusal::kTooLong);
}

// Both headers can be read, for the choice and again, and then no image.
TEST_F(KeeperTest, AnImageThatCannotBeReadIsNotStartedWith) {
  VERIFIES("LASSO-IMG-015~1");
  ASSERT_EQ(start().status, Status::kOk);
  restart();
  store_.reads_left = 3;
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kNoData);
  EXPECT_FALSE(keeper_->started());
}

TEST_F(KeeperTest, AnImageBeforeThatHasDecayedIsNotRolledBackTo) {
  VERIFIES("LASSO-IMG-016~2");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  keeper_->swap();
  keeper_->confirm();
  ASSERT_EQ(keeper_->can_roll_back(), ImageRefusal::kNone);
  store_.broken = true;
  buffer(0)[9000] ^= 0x20;
  ASSERT_TRUE(scrub());
  EXPECT_FALSE(keeper_->repair().repaired);
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kNotReady);
}

// The store holds two that were never active one after the other.
TEST_F(KeeperTest, AnImageOfAnotherPeriodIsNotRolledBackTo) {
  VERIFIES("LASSO-IMG-016~2");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  keeper_->swap();
  keeper_->confirm();
  restart();
  ASSERT_EQ(start(image_of(512, 0.4)).status, Status::kOk);
  restart();
  ASSERT_EQ(keeper_->start_stored(1).status, Status::kOk);
  EXPECT_EQ(keeper_->view(0).mission.parameters.period_s, 0.4);
  EXPECT_EQ(keeper_->other().view(0).mission.parameters.period_s, 0.2);
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kDoesNotFit);
}

TEST_F(KeeperTest, StartsWhereTheImageLies) {
  VERIFIES("LASSO-IMG-011~1");
  TestImage image = old_image();
  std::memcpy(buffer(1).data(), image.data(), image.size);
  ASSERT_EQ(keeper_->start(buffer(1).first(image.size), 1).status, Status::kOk);
  EXPECT_EQ(keeper_->active_number(), 1);
  ASSERT_EQ(keeper_->start(Bytes(image.data(), image.size), 1).status, Status::kOk);  // anywhere
  EXPECT_EQ(keeper_->active_number(), 0);
  EXPECT_EQ(points(), 512);
  image = old_image();
  image.data()[100] ^= 1;
  EXPECT_NE(keeper_->start(Bytes(image.data(), image.size), 1).status, Status::kOk);
  EXPECT_FALSE(keeper_->started());
}

}  // namespace
}  // namespace lasso
