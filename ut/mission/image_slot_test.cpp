#include "fsw/mission/image_slot.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "fsw/core/crc.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/box_parts.hpp"
#include "ut/support/box_sensors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class ImageSlotTest : public ::testing::Test {
 protected:
  ImageSlotTest() { take(test::make_box_image(preset_parameters())); }
  void take(const test::TestImage& image) {
    image_ = image;
    received_ = image;
    slot_->use(Bytes(image_.data(), image_.size));
    slot_->open(static_cast<std::uint32_t>(image_.size));
  }

  test::TestImage image_, received_;
  std::unique_ptr<ImageSlot> slot_ = std::make_unique<ImageSlot>();
};

// In slices it comes to the very bytes and views of all at once.
TEST_F(ImageSlotTest, SlicesComeToTheSameAsAllAtOnce) {
  VERIFIES("LASSO-IMG-013~1");
  auto boxes = test::make_image(preset_parameters(),
                                test::with_parts(test::make_box_tables(test::BoxModel{}), test::two_halves(), preset_parameters()));
  take(boxes);
  const auto mission = std::make_unique<Mission>();
  const auto parts = std::make_unique<Parts>();
  ASSERT_EQ(load_image(Bytes(boxes.data(), boxes.size), *mission, *parts).status, Status::kOk);
  slot_->begin_check();
  std::uint32_t steps = 0;
  while (slot_->state() != ImageState::kReady) {
    ASSERT_NE(slot_->state(), ImageState::kRefused) << slot_->result().what;
    if (slot_->state() == ImageState::kStoring) slot_->begin_conversion();
    slot_->step(501, 1);
    ++steps;
  }
  EXPECT_GT(steps, 10U);
  EXPECT_EQ(image_.storage, boxes.storage);
  EXPECT_EQ(slot_->view(0).mission.image_crc, mission->image_crc);
  EXPECT_EQ(slot_->view(0).parts.size(), parts->size());
  EXPECT_EQ(slot_->sealed_image().size(), boxes.size);
  EXPECT_EQ(slot_->image_sums()[0], crc32c(ConstBytes(boxes.data(), kChunkBytes)));
}

TEST_F(ImageSlotTest, RefusesWhatIsWrongAndWhatDoesNotFit) {
  VERIFIES("LASSO-IMG-013~1");
  image_.data()[image_.size / 2] ^= 1;
  slot_->run(1);
  EXPECT_EQ(slot_->state(), ImageState::kRefused);
  EXPECT_EQ(slot_->result().status, Status::kBadCrc);
  take(received_);
  slot_->run(0);
  EXPECT_EQ(slot_->state(), ImageState::kRefused);
  EXPECT_STREQ(slot_->result().what, "the mission has more sensors than are connected");
  EXPECT_TRUE(slot_->sealed_image().empty());
  EXPECT_TRUE(slot_->sealed_views().empty());
}

TEST_F(ImageSlotTest, NothingIsSealedBeforeItIsReady) {
  VERIFIES("LASSO-IMG-011~1");
  EXPECT_TRUE(slot_->sealed_image().empty());
  slot_->step(100, 1);  // nothing to do
  EXPECT_EQ(slot_->state(), ImageState::kLoading);
  slot_->run(1);
  EXPECT_EQ(slot_->state(), ImageState::kReady);
  EXPECT_EQ(slot_->sealed_views().size(), sizeof(MissionView));
  EXPECT_EQ(slot_->views_sums()[0], crc32c(chunk_of(slot_->sealed_views(), 0)));
}

// Any piece of what was received becomes what lies in memory.
TEST_F(ImageSlotTest, APieceThatIsReceivedAgainPutsTheImageRight) {
  VERIFIES("LASSO-IMG-016~1");
  slot_->run(1);
  const auto right = image_.storage;
  for (std::size_t at = 0; at < image_.size; at += 252) {
    const std::size_t size = image_.size - at < 252 ? image_.size - at : 252;
    std::uint8_t piece[252];
    std::memcpy(piece, received_.data() + at, size);
    slot_->convert_piece(at, Bytes(piece, size));
    image_.data()[at] ^= 0x10;
    slot_->repair(at, ConstBytes(piece, size));
  }
  EXPECT_EQ(image_.storage, right);
}

TEST_F(ImageSlotTest, ViewsAreMadeAgainForEachSensor) {
  VERIFIES("LASSO-IMG-016~1");
  test::BoxTables tables = test::make_box_tables(test::BoxModel{});
  test::append_sensor(preset_parameters(), tables[test::kSensorsTable]);
  take(test::make_image(preset_parameters(), tables));
  slot_->run(2);
  ASSERT_EQ(slot_->state(), ImageState::kReady) << slot_->result().what;
  EXPECT_EQ(slot_->sealed_views().size(), 2 * sizeof(MissionView));
  auto* memory = const_cast<std::uint8_t*>(slot_->sealed_views().data());
  memory[sizeof(MissionView) + 100] ^= 1;
  slot_->make_views();
  EXPECT_EQ(slot_->views_sums()[0], crc32c(chunk_of(slot_->sealed_views(), 0)));
  EXPECT_EQ(slot_->view(1).mission.parameters.points, preset_parameters().points);
}

}  // namespace
}  // namespace lasso
