// A component that authenticates: signed images, and another key by the link.
#include "ut/exec/component_operator.hpp"
#include "ut/exec/memory_scene.hpp"
#include "ut/support/signed_image.hpp"

namespace lasso {
namespace {

using test::MemoryScene;
using test::Packet;
using test::signed_image;
using test::Stream;
using test::TestImage;

// Its codes are no codes: the trailer's first byte is the number of the key.
class NumberedKeys final : public test::ImageSum {
 public:
  std::size_t trailer_bytes() const override { return 1; }
  bool authentic(ConstBytes, ConstBytes trailer) override {
    by_trial_ = trial_ != 0 && trailer[0] == trial_;
    return by_trial_ || trailer[0] == in_use;
  }
  bool try_key(std::uint32_t number) override {
    if (number <= in_use || number > 9) return false;
    trial_ = number;
    return true;
  }
  bool by_key_on_trial() const override { return by_trial_; }
  bool end_key_trial(bool kept) override {
    if (kept && store_full) return false;
    if (trial_ != 0 && kept) in_use = trial_;
    trial_ = 0;
    return true;
  }
  std::uint32_t in_use = 0;
  bool store_full = false;

 private:
  std::uint32_t trial_ = 0;
  bool by_trial_ = false;
};

class CommandServicesTest : public ::testing::Test {
 protected:
  void begin(const TestImage& image) {
    scene_.component->use_authenticator(keys_);
    scene_.begin(image);
  }
  // By the key of this number.
  ServiceRefusal send(Stream packet, std::uint8_t key) {
    packet.resize(packet.size() - kPacketTrailerBytes);
    packet[5] = static_cast<std::uint8_t>(packet[5] + 1);
    packet.push_back(key);
    packet.resize(packet.size() + kPacketTrailerBytes);
    test::repair_crc(packet);
    EXPECT_TRUE(scene_.component->receive_packet(test::view(packet), scene_.component->next_slot_us()));
    return test::answer_in(test::packets_of(test::telemetry_of(*scene_.component)));
  }
  ServiceRefusal change(std::uint32_t number, std::uint8_t key) {
    EXPECT_EQ(send(test::arm(CommandKind::kChangeKey, count_++), key), ServiceRefusal::kNone);
    return send(test::of_key(CommandKind::kChangeKey, number, count_++), key);
  }
  ServiceRefusal confirm(std::uint32_t number, std::uint8_t key) {
    return send(test::of_key(CommandKind::kConfirmKey, number, count_++), key);
  }
  void run(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) scene_.run_frame(false);
  }
  std::uint32_t key_of(EventId id) const {
    const test::Event event = scene_.last(id);
    return ByteReader(ConstBytes(event.items.data(), event.items.size())).u32();
  }

  MemoryScene scene_;
  NumberedKeys keys_;
  std::uint16_t count_ = 0;
};

TEST_F(CommandServicesTest, TakesSignedImagesAlone) {
  VERIFIES("LASSO-IMG-022~1");
  scene_.component->use_authenticator(keys_);
  TestImage plain = test::first_image();
  EXPECT_EQ(scene_.component->load_image(Bytes(plain.data(), plain.size)).status, Status::kNotSigned);
  scene_.restart();
  begin(signed_image(test::first_image()));
  EXPECT_EQ(scene_.component->mission().image_crc, test::crc_of(test::first_image()));
  scene_.run_frames(2);
  for (const bool is_signed : {false, true}) {
    TestImage image = is_signed ? signed_image(test::better_image()) : test::better_image();
    if (is_signed) image.data()[400] ^= 1;
    ASSERT_EQ(scene_.component->open_image(static_cast<std::uint32_t>(image.size), test::crc_of(test::better_image())),
              ImageRefusal::kNone);
    ASSERT_EQ(scene_.component->put_image(0, ConstBytes(image.data(), image.size)), ImageRefusal::kNone);
    ASSERT_EQ(scene_.component->check_image(), ImageRefusal::kNone);
    for (int i = 0; i < 100 && scene_.component->images().other().state() == ImageState::kChecking; ++i) scene_.run_frame();
    const Status why = is_signed ? Status::kNotAuthentic : Status::kNotSigned;
    EXPECT_EQ(scene_.component->images().other().result().status, why);
    scene_.run_frame();
    EXPECT_EQ(scene_.last(EventId::kImageRefused).items.front(), static_cast<std::uint8_t>(why));
    EXPECT_EQ(scene_.component->activate_image(test::crc_of(test::better_image())), ImageRefusal::kNotReady);
  }
}

TEST_F(CommandServicesTest, ASignedImageIsLoadedInFlightAndStartedFromTheStore) {
  VERIFIES("LASSO-IMG-022~1");
  begin(signed_image(test::first_image()));
  scene_.run_frames(2);
  const TestImage better = signed_image(test::better_image());
  ASSERT_EQ(scene_.component->open_image(static_cast<std::uint32_t>(better.size), test::crc_of(test::better_image())), ImageRefusal::kNone);
  TestImage copy = better;
  ASSERT_EQ(scene_.component->put_image(0, ConstBytes(copy.data(), copy.size)), ImageRefusal::kNone);
  ASSERT_EQ(scene_.component->check_image(), ImageRefusal::kNone);
  for (int i = 0; i < 200 && scene_.component->images().other().state() != ImageState::kReady; ++i) scene_.run_frame();
  ASSERT_EQ(scene_.component->activate_image(test::crc_of(test::better_image())), ImageRefusal::kNone);
  for (int i = 0; i < 40 && !scene_.told(EventId::kImageConfirmed); ++i) scene_.run_frame();
  ASSERT_TRUE(scene_.told(EventId::kImageConfirmed));
  scene_.restart();
  scene_.component->use_authenticator(keys_);
  ASSERT_EQ(scene_.component->load_stored_image().status, Status::kOk);
  EXPECT_EQ(scene_.component->mission().image_crc, test::crc_of(test::better_image()));
}

TEST_F(CommandServicesTest, AHostThatIsSureTakesUnsignedImagesToo) {
  VERIFIES("LASSO-IMG-022~1");
  scene_.component->accept_unsigned_images();
  begin(test::first_image());
  EXPECT_EQ(scene_.component->mission().image_crc, test::crc_of(test::first_image()));
}

TEST_F(CommandServicesTest, AHostWhoseLinkAuthenticatesHasItsImagesJudgedAlone) {
  VERIFIES("LASSO-IMG-022~1");
  scene_.component->authenticate_images(keys_);
  TestImage plain = test::first_image();
  EXPECT_EQ(scene_.component->load_image(Bytes(plain.data(), plain.size)).status, Status::kNotSigned);
  scene_.begin(signed_image(test::first_image()));
  const Stream ping = test::ping(1);
  EXPECT_TRUE(scene_.component->receive_packet(test::view(ping), scene_.component->next_slot_us()));
  EXPECT_EQ(test::answer_in(test::packets_of(test::telemetry_of(*scene_.component))), ServiceRefusal::kNone);
}

TEST_F(CommandServicesTest, ANewKeyTakesTheOldOnesPlaceOnceItIsConfirmed) {
  VERIFIES("LASSO-LNK-046~2");
  begin(signed_image(test::first_image()));
  EXPECT_EQ(send(test::of_key(CommandKind::kChangeKey, 3, count_++), 0), ServiceRefusal::kNotArmed);
  EXPECT_EQ(change(10, 0), ServiceRefusal::kNoSuchKey);
  EXPECT_EQ(change(3, 0), ServiceRefusal::kNone);
  run(1);
  EXPECT_EQ(key_of(EventId::kKeyOnTrial), 3U);
  EXPECT_EQ(send(test::ping(count_++), 0), ServiceRefusal::kNone) << "both count";
  EXPECT_EQ(confirm(3, 0), ServiceRefusal::kNotByNewKey);
  EXPECT_EQ(change(4, 3), ServiceRefusal::kKeyOnTrial);
  EXPECT_EQ(confirm(3, 3), ServiceRefusal::kNone);
  run(kKeyTrialFrames + 1);
  EXPECT_EQ(key_of(EventId::kKeyConfirmed), 3U);
  EXPECT_FALSE(scene_.told(EventId::kKeyGivenUp));
  EXPECT_EQ(keys_.in_use, 3U);
}

TEST_F(CommandServicesTest, AKeyThatARestartWouldLoseIsNotConfirmed) {
  VERIFIES("LASSO-LNK-052~1");
  begin(signed_image(test::first_image()));
  EXPECT_EQ(change(3, 0), ServiceRefusal::kNone);
  keys_.store_full = true;
  EXPECT_EQ(confirm(3, 3), ServiceRefusal::kNotKept);
  run(1);
  EXPECT_FALSE(scene_.told(EventId::kKeyConfirmed));
  EXPECT_EQ(keys_.in_use, 0U);
  EXPECT_EQ(send(test::ping(count_++), 0), ServiceRefusal::kNone) << "both count";
  keys_.store_full = false;
  EXPECT_EQ(confirm(3, 3), ServiceRefusal::kNone);
  run(1);
  EXPECT_EQ(key_of(EventId::kKeyConfirmed), 3U);
}

TEST_F(CommandServicesTest, AKeyThatNobodyConfirmsIsGivenUp) {
  VERIFIES("LASSO-LNK-046~2");
  begin(signed_image(test::first_image()));
  EXPECT_EQ(change(3, 0), ServiceRefusal::kNone);
  run(kKeyTrialFrames - 1);
  EXPECT_FALSE(scene_.told(EventId::kKeyGivenUp));
  run(2);
  EXPECT_EQ(key_of(EventId::kKeyGivenUp), 3U);
  EXPECT_EQ(confirm(3, 0), ServiceRefusal::kNoKeyOnTrial);
  EXPECT_EQ(keys_.in_use, 0U);
}

}  // namespace
}  // namespace lasso
