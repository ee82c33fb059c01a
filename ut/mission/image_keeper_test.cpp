#include "fsw/mission/image_keeper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "fsw/mission/stored_record.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/ram_store.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::TestImage;
constexpr DurationUs kSlot_us = 10000;

TestImage image_of(double points, double period_s = 0.2) {
  MissionParameters parameters = preset_parameters();
  parameters.points = points;
  parameters.period_s = period_s;
  return test::make_box_image(parameters);
}
std::uint32_t crc_of(TestImage image) {
  std::uint32_t crc = 0;
  for (std::size_t i = 0; i < 4; ++i) crc = crc << 8 | image.data()[image.size - 4 + i];
  return crc;
}

class KeeperTest : public ::testing::Test {
 protected:
  static const TestImage& old_image() {
    static const TestImage image = image_of(512);
    return image;
  }
  static const TestImage& new_image() {
    static const TestImage image = image_of(600);
    return image;
  }

  KeeperTest() : store_(old_image().size + 4096) { restart(); }

  // Power comes back: memory is as it was never before, the store as it was.
  void restart(bool with_store = true) {
    for (auto& buffer : buffers_) buffer.assign(old_image().storage.size() + 64, 0x5555555555555555U);
    keeper_ = std::make_unique<ImageKeeper>();
    ASSERT_EQ(keeper_->use_buffers(buffer(0), buffer(1)), Status::kOk);
    if (with_store) keeper_->use_store(store_);
  }
  Bytes buffer(std::size_t i) { return {reinterpret_cast<std::uint8_t*>(buffers_[i].data()), 8 * buffers_[i].size()}; }
  LoadFailure start(const TestImage& image = old_image()) {
    std::memcpy(buffer(0).data(), image.storage.data(), image.size);
    return keeper_->start(buffer(0).first(image.size), 1);
  }
  ImageRefusal open(const TestImage& image) { return keeper_->open(static_cast<std::uint32_t>(image.size), crc_of(image)); }
  ImageRefusal put(const TestImage& image, std::size_t block) {
    TestImage copy = image;
    const std::size_t at = block * kLoadBlockBytes;
    return keeper_->put(static_cast<std::uint32_t>(at),
                        ConstBytes(copy.data() + at, std::min<std::size_t>(kLoadBlockBytes, copy.size - at)));
  }
  std::size_t blocks(const TestImage& image) const { return (image.size + kLoadBlockBytes - 1) / kLoadBlockBytes; }
  void upload(const TestImage& image) {
    ASSERT_EQ(open(image), ImageRefusal::kNone);
    TestImage copy = image;
    ASSERT_EQ(keeper_->put(0, ConstBytes(copy.data(), copy.size)), ImageRefusal::kNone);
  }
  // Slots until the other image is ready, or refused; how many.
  std::uint32_t work() {
    std::uint32_t slots = 0;
    const auto busy = [&] { return keeper_->other().state() != ImageState::kReady && keeper_->other().state() != ImageState::kRefused; };
    for (; busy() && slots < 10000; ++slots) keeper_->step(1);
    return slots;
  }
  void make_ready(const TestImage& image) {
    upload(image);
    ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
    work();
    ASSERT_EQ(keeper_->other().state(), ImageState::kReady) << keeper_->other().result().what;
  }
  double points() const { return keeper_->view(0).mission.parameters.points; }
  // Scrubs for one period at most; whether something was found.
  bool scrub() {
    for (DurationUs t = 0; t < kScrubPeriod_us + 20 * kSlot_us; t += kSlot_us) {
      if (keeper_->scrub(kSlot_us)) return true;
    }
    return false;
  }
  std::vector<std::uint8_t> active_bytes() {
    const ConstBytes bytes = keeper_->active().sealed_image();
    return {bytes.begin(), bytes.end()};
  }

  std::vector<std::uint64_t> buffers_[2];
  test::RamStore store_;
  std::unique_ptr<ImageKeeper> keeper_;
};

TEST_F(KeeperTest, BuffersAreOfOneSizeAndAligned) {
  VERIFIES("LASSO-IMG-011~1");
  ImageKeeper& keeper = *keeper_;
  EXPECT_EQ(keeper.use_buffers(buffer(0), buffer(1).first(64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(buffer(0).subspan(4, 64), buffer(1).first(64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(buffer(0).first(64), buffer(1).subspan(4, 64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(Bytes(buffer(0).data(), kMaxImageBytes + 8), Bytes(buffer(1).data(), kMaxImageBytes + 8)),
            Status::kBadValue);
  EXPECT_EQ(keeper.watch_code(ConstBytes(buffer(0).data(), 256 * kChunkBytes + 1)), Status::kOverCapacity);
}

TEST_F(KeeperTest, TheImageThatIsLoadedIsNotUsedAndTheActiveOneNotTouched) {
  VERIFIES("LASSO-IMG-011~1");
  ASSERT_EQ(start().status, Status::kOk);
  const std::vector<std::uint8_t> before = active_bytes();
  upload(new_image());
  EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNotReady);
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kNotReady);
  ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
  while (keeper_->other().state() != ImageState::kReady) {
    EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNotReady);
    EXPECT_EQ(put(new_image(), 0), ImageRefusal::kNotOpen);
    EXPECT_EQ(open(new_image()), ImageRefusal::kBusy);
    EXPECT_EQ(points(), 512);
    keeper_->step(1);
  }
  EXPECT_EQ(active_bytes(), before);
  EXPECT_EQ(keeper_->can_activate(crc_of(old_image())), ImageRefusal::kOtherImage);
  EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNone);
  keeper_->swap();
  EXPECT_EQ(points(), 600);
  EXPECT_EQ(keeper_->active_number(), 1);
  EXPECT_EQ(open(new_image()), ImageRefusal::kBusy);  // on trial: the image before may be wanted back
  EXPECT_EQ(keeper_->can_roll_back(), ImageRefusal::kNone);
  keeper_->swap();
  EXPECT_EQ(points(), 512);
  EXPECT_EQ(active_bytes(), before);
}

// Backwards, with a break, some twice.
TEST_F(KeeperTest, PartsComeInAnyOrderAndAreResumed) {
  VERIFIES("LASSO-IMG-012~1");
  ASSERT_EQ(start().status, Status::kOk);
  ASSERT_EQ(open(new_image()), ImageRefusal::kNone);
  const std::size_t all = blocks(new_image());
  for (std::size_t i = all; i-- > all / 2;) ASSERT_EQ(put(new_image(), i), ImageRefusal::kNone);
  EXPECT_EQ(keeper_->begin_check(), ImageRefusal::kIncomplete);
  EXPECT_EQ(keeper_->map().missing(0).count, all / 2);
  ASSERT_EQ(open(new_image()), ImageRefusal::kNone);  // the next pass: the same image
  EXPECT_EQ(keeper_->map().loaded(), all - all / 2);
  for (std::size_t i = 0; i < all / 2 + 3; ++i) ASSERT_EQ(put(new_image(), (i * 7919) % all), ImageRefusal::kNone);
  for (BlockRun run = keeper_->map().missing(0); run.count > 0; run = keeper_->map().missing(0)) {
    ASSERT_EQ(put(new_image(), run.first), ImageRefusal::kNone);
  }
  ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
  work();
  EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNone);
}

TEST_F(KeeperTest, RefusesPartsThatDoNotBelong) {
  VERIFIES("LASSO-IMG-012~1");
  ASSERT_EQ(start().status, Status::kOk);
  EXPECT_EQ(put(new_image(), 0), ImageRefusal::kNotOpen);
  EXPECT_EQ(keeper_->begin_check(), ImageRefusal::kNotOpen);
  EXPECT_EQ(keeper_->open(static_cast<std::uint32_t>(buffer(1).size() + 1), 1), ImageRefusal::kTooLong);
  EXPECT_EQ(keeper_->open(kLoadBlockBytes - 1, 1), ImageRefusal::kTooLong);
  ASSERT_EQ(keeper_->open(1000, 1), ImageRefusal::kNone);
  const std::uint8_t part[300] = {};
  EXPECT_EQ(keeper_->put(1001, ConstBytes(part, 0)), ImageRefusal::kOutside);
  EXPECT_EQ(keeper_->put(896, ConstBytes(part, 105)), ImageRefusal::kOutside);
  EXPECT_EQ(keeper_->put(0xFFFFFF80U, ConstBytes(part, 128)), ImageRefusal::kOutside);
  EXPECT_EQ(keeper_->put(64, ConstBytes(part, 64)), ImageRefusal::kNotWhole);
  EXPECT_EQ(keeper_->put(128, ConstBytes(part, 100)), ImageRefusal::kNotWhole);
  EXPECT_EQ(keeper_->put(768, ConstBytes(part, 232)), ImageRefusal::kNone);  // to the end of the image
  EXPECT_EQ(keeper_->map().loaded(), 2U);
  ASSERT_EQ(keeper_->open(1000, 2), ImageRefusal::kNone);  // another image
  EXPECT_EQ(keeper_->map().loaded(), 0U);
  for (std::uint32_t at = 0; at < 1000; at += 256) {
    EXPECT_EQ(keeper_->put(at, ConstBytes(part, std::min(256U, 1000 - at))), ImageRefusal::kNone);
  }
  EXPECT_EQ(keeper_->begin_check(), ImageRefusal::kOtherImage);  // its last bytes are not the check sum that was named
  ASSERT_EQ(keeper_->open(1200, 2), ImageRefusal::kNone);
  EXPECT_EQ(keeper_->map().loaded(), 0U);
}

TEST_F(KeeperTest, WithoutASecondBufferNothingIsLoaded) {
  VERIFIES("LASSO-IMG-011~1");
  TestImage image = old_image();
  keeper_ = std::make_unique<ImageKeeper>();
  ASSERT_EQ(keeper_->start(Bytes(image.data(), image.size), 1).status, Status::kOk);
  EXPECT_EQ(open(new_image()), ImageRefusal::kNoBuffer);
  EXPECT_EQ(keeper_->start_stored(1).status, Status::kNoData);
}

TEST_F(KeeperTest, AnImageThatIsWrongIsRefusedAndTheNextOneTaken) {
  VERIFIES("LASSO-IMG-013~1");
  ASSERT_EQ(start().status, Status::kOk);
  TestImage wrong = new_image();
  wrong.data()[wrong.size / 2] ^= 4;
  upload(wrong);
  ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
  work();
  EXPECT_EQ(keeper_->other().state(), ImageState::kRefused);
  EXPECT_EQ(keeper_->other().result().status, Status::kBadCrc);
  EXPECT_EQ(points(), 512);
  make_ready(new_image());
  EXPECT_EQ(keeper_->can_activate(crc_of(new_image())), ImageRefusal::kNone);
}

TEST_F(KeeperTest, AnImageOfAnotherFrameIsNotActivated) {
  VERIFIES("LASSO-IMG-013~1");
  ASSERT_EQ(start().status, Status::kOk);
  const TestImage slower = image_of(600, 0.4);
  make_ready(slower);
  EXPECT_EQ(keeper_->can_activate(crc_of(slower)), ImageRefusal::kDoesNotFit);
}

// A slot's work stays what it is for an image of any size: slots grow with its words.
TEST_F(KeeperTest, WorkIsSpreadOverSlots) {
  VERIFIES("LASSO-IMG-013~1");
  ASSERT_EQ(start().status, Status::kOk);
  store_.largest_write = 0;
  upload(new_image());
  ASSERT_EQ(keeper_->begin_check(), ImageRefusal::kNone);
  const std::size_t words = new_image().size / 4;
  const std::uint32_t slots = work();
  EXPECT_GE(slots, 3 * words / (kImageWordsPerSlot + kLargestRecord_words));
  EXPECT_LE(slots, 8 * words / kImageWordsPerSlot + 60);
  EXPECT_LE(store_.largest_write, kMaxStoreWriteBytes);
}

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
  VERIFIES("LASSO-IMG-015~1 LASSO-IMG-016~1");
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
  VERIFIES("LASSO-IMG-016~1");
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

// The medium fails between the two readings of a repair: what was written is right, and the next repair does the rest.
TEST_F(KeeperTest, ARepairThatIsCutShortMakesNothingWorse) {
  VERIFIES("LASSO-IMG-016~1");
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

// A flip anywhere in either image, or in what was made of them: found within a period, repaired from the store, bit by bit.
TEST_F(KeeperTest, FlipsAreFoundWithinAPeriodAndRepaired) {
  VERIFIES("LASSO-IMG-016~1 LASSO-IMG-017~1 LASSO-HLT-010~1");
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
  VERIFIES("LASSO-IMG-016~1 LASSO-IMG-017~1");
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
  VERIFIES("LASSO-IMG-016~1");
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

}  // namespace
}  // namespace lasso
