// Loading, checking and changing of images.
#include <algorithm>

#include "ut/mission/keeper_fixture.hpp"

namespace lasso {
namespace {

using test::crc_of;
using test::image_of;
using test::KeeperTest;
using test::kSlot_us;
using test::TestImage;

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

TEST_F(KeeperTest, BuffersAreMemoryAndShareNoByte) {
  VERIFIES("LASSO-IMG-011~1");
  ImageKeeper& keeper = *keeper_;
  const Bytes memory = buffer(0);
  EXPECT_EQ(keeper.use_buffers(memory.first(64), memory.first(64)), Status::kBadValue) << "the same twice";
  EXPECT_EQ(keeper.use_buffers(memory.first(64), memory.subspan(56, 64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(memory.subspan(56, 64), memory.first(64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(memory.first(64), memory.subspan(64, 64)), Status::kOk) << "one behind the other";
  EXPECT_EQ(keeper.use_buffers(Bytes(nullptr, 64), memory.first(64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers(memory.first(64), Bytes(nullptr, 64)), Status::kBadValue);
  EXPECT_EQ(keeper.use_buffers({}, {}), Status::kOk) << "none";
}

// What is uploaded later would be written over the image that flies.
TEST_F(KeeperTest, TheFirstImageIsMemoryAndLeavesTheOtherBufferFree) {
  VERIFIES("LASSO-IMG-011~1");
  EXPECT_EQ(keeper_->start(Bytes(nullptr, 64), 1).status, Status::kBadValue);
  EXPECT_FALSE(keeper_->started());
  const Bytes second = buffer(1);
  EXPECT_EQ(keeper_->start(second.subspan(8, second.size() - 8), 1).status, Status::kBadValue);
  EXPECT_FALSE(keeper_->started());
  EXPECT_EQ(start().status, Status::kOk);
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

// Where in a keeper's memory lie the copies of which image is active, of which it is the second one; before them, the number itself.
std::uint32_t* copies_of_selection(ImageKeeper& keeper) {
  constexpr std::uint32_t kCopies[] = {1, ~1u, 1};
  auto* words = reinterpret_cast<std::uint32_t*>(&keeper);
  auto* end = words + sizeof(ImageKeeper) / sizeof(std::uint32_t);
  auto* found = std::search(words, end, kCopies, kCopies + 3);
  EXPECT_NE(found, end);
  return found;
}

TEST_F(KeeperTest, WhichImageIsActiveSurvivesAFlip) {
  VERIFIES("LASSO-HLT-014~3");
  ASSERT_EQ(start().status, Status::kOk);
  make_ready(new_image());
  keeper_->swap();
  EXPECT_TRUE(keeper_->keep_selection());
  std::uint32_t* const copies = copies_of_selection(*keeper_);
  auto* const number = reinterpret_cast<std::size_t*>(copies) - 1;
  for (std::size_t bit = 0; bit < 96; ++bit) {
    copies[bit / 32] ^= 1u << bit % 32;
    EXPECT_FALSE(keeper_->keep_selection()) << bit;
    EXPECT_TRUE(keeper_->keep_selection()) << bit;
    EXPECT_EQ(points(), 600);
  }
  for (std::size_t bit = 0; bit < 8 * sizeof(std::size_t); ++bit) {
    *number ^= std::size_t{1} << bit;
    EXPECT_EQ(points(), 600) << "before the boundary: " << bit;
    EXPECT_EQ(keeper_->active_number(), 1) << bit;
    EXPECT_EQ(keeper_->other().image_parameters().points, 512) << bit;
    EXPECT_FALSE(keeper_->keep_selection()) << bit;
    EXPECT_TRUE(keeper_->keep_selection()) << bit;
    EXPECT_EQ(points(), 600);
  }
  copies[0] = 7;
  copies[2] = 9;
  EXPECT_FALSE(keeper_->keep_selection()) << "no two agree";
  EXPECT_EQ(keeper_->active_number(), 1) << "the number itself";
}

// Where the state of the active image lies: what keep_selection() puts right of a refusal.
std::uint8_t* state_of_active(ImageKeeper& keeper) {
  auto& slot = const_cast<ImageSlot&>(keeper.active());
  auto* const bytes = reinterpret_cast<std::uint8_t*>(&slot);
  slot.refuse(Status::kBadCrc, "a flip");
  const std::vector<std::uint8_t> refused(bytes, bytes + sizeof slot);
  EXPECT_FALSE(keeper.keep_selection());
  const auto place = std::mismatch(refused.begin(), refused.end(), bytes).second;
  EXPECT_NE(place, bytes + sizeof slot);
  return place;
}

// An image whose state is another one would not be scrubbed any more. Each bit of it is put right at the boundary.
TEST_F(KeeperTest, TheActiveImageStaysReady) {
  VERIFIES("LASSO-HLT-014~3");
  ASSERT_EQ(start().status, Status::kOk);
  std::uint8_t* const state = state_of_active(*keeper_);
  ASSERT_EQ(*state, static_cast<std::uint8_t>(ImageState::kReady));
  for (unsigned bit = 0; bit < 8; ++bit) {
    *state = static_cast<std::uint8_t>(*state ^ 1u << bit);
    EXPECT_TRUE(keeper_->active().sealed_image().empty()) << bit;
    EXPECT_FALSE(keeper_->keep_selection()) << bit;
    EXPECT_EQ(keeper_->active().sealed_image().size(), old_image().size) << bit;
    EXPECT_TRUE(keeper_->keep_selection()) << bit;
  }
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
  EXPECT_EQ(keeper_->begin_check(), ImageRefusal::kOtherImage);  // its last bytes are not the checksum that was named
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

}  // namespace
}  // namespace lasso
