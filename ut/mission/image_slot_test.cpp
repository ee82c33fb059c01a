#include "fsw/mission/image_slot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "fsw/core/crc.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/box_parts.hpp"
#include "ut/support/box_sensors.hpp"
#include "ut/support/signed_image.hpp"
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
  VERIFIES("LASSO-IMG-016~2");
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
  VERIFIES("LASSO-IMG-016~2");
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

// What is refused, and why.
class SignedSlotTest : public ImageSlotTest {
 protected:
  SignedSlotTest() { slot_->use_authenticator(sums_); }
  Status status_of(const test::TestImage& image) {
    take(image);
    slot_->run(1);
    return slot_->result().status;
  }
  const test::TestImage plain_ = test::make_box_image(preset_parameters());
  const test::TestImage signed_ = test::signed_image(plain_);
  test::ImageSum sums_;
};

TEST_F(SignedSlotTest, AnImageIsTakenWithARightSignatureAlone) {
  VERIFIES("LASSO-IMG-022~1");
  EXPECT_EQ(status_of(signed_), Status::kOk);
  EXPECT_EQ(slot_->state(), ImageState::kReady);
  EXPECT_EQ(slot_->sealed_image().size(), signed_.size) << "the signature is scrubbed as well";
  const std::uint32_t crc = slot_->view(0).mission.image_crc;
  EXPECT_EQ(status_of(plain_), Status::kNotSigned);
  slot_->accept_unsigned();
  EXPECT_EQ(status_of(plain_), Status::kOk);
  EXPECT_EQ(slot_->view(0).mission.image_crc, crc) << "an image's name does not depend on its signature";
  EXPECT_EQ(status_of(signed_), Status::kOk);
}

// A bit of each byte of the header and of the signature, and of some between. A repaired CRC helps nobody.
TEST_F(SignedSlotTest, EveryChangedByteIsRefusedBeforeItIsRead) {
  VERIFIES("LASSO-IMG-022~1");
  const std::size_t stride = signed_.size / 40;
  for (std::size_t at = 0; at < signed_.size; at += at < 32 || at + 16 > signed_.size ? 1 : std::min(stride, signed_.size - 16 - at) | 1U) {
    test::TestImage other = signed_;
    other.data()[at] = static_cast<std::uint8_t>(other.data()[at] ^ (1U << (at % 8)));
    const bool claims_all = at == 11;  // its length field takes the signature for a part of the image
    ASSERT_EQ(status_of(other), claims_all ? Status::kNotSigned : Status::kNotAuthentic) << at;
  }
  test::TestImage forged = plain_;
  forged.data()[19] = 99;
  test::repair_crcs(forged);
  test::TestImage of_another = test::signed_image(forged);
  std::memcpy(of_another.data() + plain_.size, test::TestImage(signed_).data() + plain_.size, test::kImageSumBytes);
  EXPECT_EQ(status_of(of_another), Status::kNotAuthentic) << "the signature of another image";
  slot_->accept_unsigned();
  EXPECT_EQ(status_of(of_another), Status::kNotAuthentic) << "a wrong signature is worse than none";
}

TEST_F(SignedSlotTest, WhatIsTooShortHasNoSignature) {
  VERIFIES("LASSO-IMG-022~1");
  for (const std::size_t size : {std::size_t{0}, std::size_t{12}, std::size_t{19}}) {
    test::TestImage cut = signed_;
    cut.size = size;
    EXPECT_EQ(status_of(cut), Status::kNotSigned) << size;
  }
  test::TestImage cut = signed_;
  cut.size = 20;
  EXPECT_EQ(status_of(cut), Status::kNotAuthentic);
}

TEST_F(SignedSlotTest, ASlotGivesTheAuthenticatorItsShareAlone) {
  VERIFIES("LASSO-IMG-022~1");
  take(signed_);
  slot_->begin_check();
  for (std::uint32_t steps = 1; steps <= (plain_.size + 2003) / 2004; ++steps) {
    slot_->step(501, 1);
    ASSERT_EQ(sums_.pieces, steps);
  }
  EXPECT_EQ(sums_.longest, 4U * 501U);
  EXPECT_EQ(slot_->state(), ImageState::kChecking) << "authentic, and not checked yet";
  while (slot_->state() == ImageState::kChecking) slot_->step(501, 1);
  EXPECT_EQ(slot_->state(), ImageState::kStoring);
}

TEST_F(ImageSlotTest, AnAuthenticatorOfCommandsAloneTakesNoImage) {
  VERIFIES("LASSO-IMG-022~1");
  class OfCommands final : public Authenticator {
    std::size_t trailer_bytes() const override { return 4; }
    bool authentic(ConstBytes, ConstBytes) override { return true; }
  } of_commands;
  Authenticator& preset = of_commands;
  slot_->use_authenticator(preset);
  slot_->run(1);
  EXPECT_EQ(slot_->result().status, Status::kNotSigned);
  preset.begin_image();
  preset.take_image({});
  EXPECT_FALSE(preset.image_authentic({}) || preset.try_key(1) || preset.by_key_on_trial() || preset.end_key_trial(true));
}

}  // namespace
}  // namespace lasso
