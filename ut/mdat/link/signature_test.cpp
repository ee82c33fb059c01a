#include "mdat/link/signature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "fsw/link/commands.hpp"
#include "mdat/common/errors.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso::mdat {
namespace {

using test::Stream;
using test::view;

const Key kKey{std::vector<std::uint8_t>(32, 0x0B), 0};

// The authenticator that a packet is given to counts what it lets pass.
PacketFault decode(Authenticator& check, const Stream& packet, Command& command) { return decode_command(view(packet), command, &check); }
PacketFault decode(Authenticator& check, const Stream& packet) {
  Command command;
  return decode(check, packet, command);
}

// An empty folder.
std::filesystem::path made_store(const std::string& name) {
  const std::filesystem::path store = std::filesystem::path(::testing::TempDir()) / name;
  std::filesystem::remove_all(store);
  std::filesystem::create_directories(store);
  return store;
}

using Image = std::vector<std::uint8_t>;

// As short as an image can be that says its length.
Image small_image() { return {'3', 'D', 'L', 'I', 0, 0, 0, 9, 0, 0, 0, 16, 1, 2, 3, 4}; }

bool takes(SignatureCheck& check, const Image& image, std::size_t piece = 5) {
  const std::size_t body = image.size() - check.image_signature_bytes();
  check.begin_image();
  for (std::size_t at = 0; at < body; at += piece) check.take_image(view(image).subspan(at, std::min(piece, body - at)));
  return check.image_authentic(view(image).subspan(body, image.size() - body));
}

TEST(Signature, ASignedCommandIsTheCommand) {
  VERIFIES("LASSO-LNK-021~2");
  Signer signer(kKey);
  SignatureCheck check(kKey);
  const Stream plain = test::set_mode(5, 77);
  const Stream packet = signer.sign(plain);
  ASSERT_EQ(packet.size(), plain.size() + 24);
  Command command;
  ASSERT_EQ(decode(check, packet, command), PacketFault::kNone);
  EXPECT_EQ(command.mode.mode, 5);
  EXPECT_EQ(command.header.sequence_count, 77);
  EXPECT_EQ(decode(check, signer.sign(test::offer_start(StartCommand{}, 78))), PacketFault::kNone) << "the longest";
}

// Independent of the code under test: computed by `openssl dgst -sha256 -mac HMAC -macopt hexkey:0b..0b` over the 19 bytes.
TEST(Signature, TheCodeIsThatOfOpenSslOnTheCommandLine) {
  VERIFIES("LASSO-LNK-021~2");
  SignatureCheck check(kKey);
  const Stream packet = test::ping(7);
  Stream by_hand(packet.begin(), packet.end() - 2);
  by_hand[5] = 30;  // 13 + 24 bytes in all
  test::append(by_hand, {0, 0, 0, 0, 0, 0, 0, 1});
  test::append(by_hand, {0x2B, 0x20, 0x79, 0x34, 0x72, 0x18, 0xAE, 0x81, 0xE6, 0xEB, 0x85, 0x97, 0xBA, 0x1B, 0xA8, 0x68});
  test::append(by_hand, {0, 0});
  test::repair_crc(by_hand);
  EXPECT_EQ(decode(check, by_hand), PacketFault::kNone);
}

TEST(Signature, WhatIsNotSignedIsRefusedAndLearnsNothing) {
  VERIFIES("LASSO-LNK-021~2");
  Signer signer(kKey), stranger(Key{std::vector<std::uint8_t>(32, 0x0C), 0});
  SignatureCheck check(kKey);
  EXPECT_EQ(decode(check, test::ping(1)), PacketFault::kNotAuthentic) << "too short for a trailer";
  EXPECT_EQ(decode(check, test::offer_start(StartCommand{}, 1)), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, stranger.sign(test::ping(1))), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, stranger.sign(test::set_mode(99, 1))), PacketFault::kNotAuthentic) << "not: bad argument";
  EXPECT_EQ(decode(check, signer.sign(test::set_mode(99, 1))), PacketFault::kBadArgument);
  Stream damaged = signer.sign(test::ping(1));
  damaged.back() ^= 1U;
  EXPECT_EQ(decode(check, damaged), PacketFault::kBadCrc) << "damage is not forgery";
}

TEST(Signature, EveryChangedBitIsRefused) {
  VERIFIES("LASSO-LNK-021~2");
  Signer signer(kKey);
  const Stream good = signer.sign(test::set_hold(1, 5));
  for (std::size_t bit = 0; bit < (good.size() - 2) * 8; ++bit) {
    SignatureCheck check(kKey);
    Stream forged = good;
    forged[bit / 8] = static_cast<std::uint8_t>(forged[bit / 8] ^ (1U << (bit % 8)));
    test::repair_crc(forged);
    const PacketFault fault = decode(check, forged);
    ASSERT_NE(fault, PacketFault::kNone) << bit;
    // Others of the primary header are other faults.
    const bool of_count = (bit >= 16 && bit < 22) || bit / 8 == 3;
    ASSERT_TRUE(!of_count || fault == PacketFault::kNotAuthentic) << bit;
  }
  SignatureCheck check(kKey);
  EXPECT_EQ(decode(check, good), PacketFault::kNone);
}

TEST(Signature, ARecordedCommandIsRefused) {
  VERIFIES("LASSO-LNK-021~2");
  Signer signer(kKey);
  SignatureCheck check(kKey);
  const Stream first = signer.sign(test::ping(1)), second = signer.sign(test::ping(2));
  EXPECT_EQ(decode(check, second), PacketFault::kNone);
  EXPECT_EQ(decode(check, second), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, first), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, signer.sign(test::ping(2))), PacketFault::kNone) << "of a number of its own";
}

// Independent of the code under test: `openssl dgst -sha256 -mac HMAC -macopt hexkey:2ca0..44fd`, the image key of key_test.cpp.
TEST(Signature, TheSignatureOfAnImageIsThatOfOpenSslOnTheCommandLine) {
  VERIFIES("LASSO-LNK-045~1");
  const Image image = {'3', 'D', 'L', 'I', '.', '.', '.', '.'};
  const Image made = sign_image(image, kKey);
  const Image expected = {0x24, 0xAD, 0xA3, 0x56, 0xDA, 0xD6, 0x1B, 0xA6, 0x88, 0x62, 0x84, 0xD6, 0x14, 0x7D, 0xC8, 0xAF,
                          0x5C, 0xE2, 0x21, 0xAA, 0x5F, 0x2D, 0x7A, 0x2A, 0xBD, 0x6E, 0x3B, 0x6D, 0xC5, 0x3B, 0x52, 0x24};
  EXPECT_EQ(Image(made.begin() + 8, made.end()), expected);
}

TEST(Signature, AnImageIsTakenAsItWasSignedAndNoOtherWay) {
  VERIFIES("LASSO-LNK-045~1");
  const Image good = sign_image(small_image(), kKey);
  SignatureCheck check(kKey);
  EXPECT_TRUE(takes(check, good));
  EXPECT_TRUE(takes(check, good, 1000)) << "in one piece";
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Image other = good;
    other[bit / 8] = static_cast<std::uint8_t>(other[bit / 8] ^ (1U << (bit % 8)));
    ASSERT_FALSE(takes(check, other)) << bit;
  }
  SignatureCheck stranger(Key{Image(32, 0x0C), 0});
  EXPECT_FALSE(takes(stranger, good));
  EXPECT_TRUE(is_signed_by(good, kKey));
  EXPECT_FALSE(is_signed_by(small_image(), kKey));
  EXPECT_FALSE(is_signed_by(good, Key{Image(32, 0x0C), 0}));
  EXPECT_EQ(sign_image(good, kKey), good) << "signed anew";
  EXPECT_THROW(static_cast<void>(sign_image(good, derive_command_key(kKey, 1))), InputError);
}

TEST(Signature, DuringATrialBothKeysCountAndNumbersGoOn) {
  VERIFIES("LASSO-LNK-046~2");
  SignatureCheck check(kKey);
  Signer before(kKey), after(derive_command_key(kKey, 3));
  const Stream early = after.sign(test::ping(1));
  EXPECT_EQ(decode(check, early), PacketFault::kNotAuthentic) << "not on trial yet";
  EXPECT_FALSE(check.try_key(0));
  ASSERT_TRUE(check.try_key(3));
  EXPECT_EQ(decode(check, before.sign(test::ping(1))), PacketFault::kNone);
  EXPECT_FALSE(check.by_key_on_trial());
  EXPECT_EQ(decode(check, early), PacketFault::kNotAuthentic) << "its number is used up";
  EXPECT_EQ(decode(check, after.sign(test::ping(1))), PacketFault::kNone);
  EXPECT_TRUE(check.by_key_on_trial());
  EXPECT_TRUE(check.end_key_trial(true));
  EXPECT_EQ(decode(check, before.sign(test::ping(1))), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, after.sign(test::ping(1))), PacketFault::kNone);
  EXPECT_FALSE(check.try_key(3)) << "numbers grow";
}

TEST(Signature, AKeyThatIsGivenUpCountsNoMore) {
  VERIFIES("LASSO-LNK-046~2");
  SignatureCheck check(kKey);
  Signer before(kKey), after(derive_command_key(kKey, 3));
  EXPECT_FALSE(check.end_key_trial(false)) << "there is none";
  ASSERT_TRUE(check.try_key(3));
  EXPECT_TRUE(check.end_key_trial(false));
  EXPECT_EQ(decode(check, after.sign(test::ping(1))), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, before.sign(test::ping(1))), PacketFault::kNone);
}

// What was recorded before a restart is refused after it, and the key in use is the same.
TEST(Signature, TheStateOutlivesARestart) {
  VERIFIES("LASSO-LNK-047~2");
  const std::filesystem::path store = made_store("lasso_signature_state");
  const SignatureCheck::Keep keep = keep_in(store);
  Signer before(kKey), after(derive_command_key(kKey, 2));
  Stream last;
  {
    SignatureCheck check(kKey, load_signature_state(store), keep);
    ASSERT_EQ(decode(check, before.sign(test::ping(1))), PacketFault::kNone);
    ASSERT_TRUE(check.try_key(2));
    last = after.sign(test::ping(2));
    ASSERT_EQ(decode(check, last), PacketFault::kNone);
    EXPECT_EQ(load_signature_state(store).key, 0U) << "on trial: it does not outlive a restart";
    EXPECT_TRUE(check.end_key_trial(true));
  }
  SignatureCheck check(kKey, load_signature_state(store), keep);
  EXPECT_EQ(decode(check, last), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, before.sign(test::ping(3))), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, after.sign(test::ping(3))), PacketFault::kNone);
}

// Its store is full when it is confirmed: a restart would begin with the key before.
TEST(Signature, AKeyThatCannotBeStoredStaysOnTrial) {
  VERIFIES("LASSO-LNK-052~1");
  const std::filesystem::path store = made_store("lasso_signature_full");
  Signer before(kKey), after(derive_command_key(kKey, 2));
  SignatureCheck check(kKey, {}, keep_in(store));
  ASSERT_TRUE(check.try_key(2));
  ASSERT_EQ(decode(check, after.sign(test::ping(1))), PacketFault::kNone);
  std::filesystem::create_directories(store / "authentication.partial" / "full");
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(check.end_key_trial(true));
  EXPECT_EQ(decode(check, before.sign(test::ping(2))), PacketFault::kNone) << "both count";
  EXPECT_EQ(decode(check, after.sign(test::ping(3))), PacketFault::kNone);
  (void)::testing::internal::GetCapturedStderr();
  EXPECT_EQ(load_signature_state(store).key, 0U);
  std::filesystem::remove_all(store / "authentication.partial");
  EXPECT_TRUE(check.end_key_trial(true));
  EXPECT_EQ(load_signature_state(store).key, 2U);
  EXPECT_EQ(decode(check, before.sign(test::ping(4))), PacketFault::kNotAuthentic);
}

// Whoever stole the key in use cannot have its last number confirmed.
TEST(Signature, AKeyFarBeyondTheOneInUseIsNotTried) {
  VERIFIES("LASSO-LNK-053~1");
  SignatureCheck first(kKey), last(kKey, {UINT32_MAX - 1, 0}), none(kKey, {UINT32_MAX, 0});
  EXPECT_FALSE(first.try_key(UINT32_MAX));
  EXPECT_FALSE(first.try_key(65'537));
  EXPECT_TRUE(first.try_key(65'536));
  EXPECT_TRUE(last.try_key(UINT32_MAX));
  EXPECT_FALSE(none.try_key(UINT32_MAX));
  EXPECT_FALSE(none.try_key(1)) << "numbers do not begin anew";
}

TEST(Signature, AStateThatNoRunLeftIsRefused) {
  VERIFIES("LASSO-LNK-047~2");
  const std::filesystem::path store = made_store("lasso_signature_states");
  for (const char* text : {"", "key two", "key 1\nnumber 5", "key 1\nnumber -5\n", "key -1\nnumber 5\n", "key 4294967296\nnumber 5\n",
                           "key 1\nnumber 5\nkey 2\n"}) {
    std::ofstream(store / "authentication") << text;
    EXPECT_THROW(static_cast<void>(state_at_start(store, "udp://:1")), InputError) << text;
  }
}

// A disk that is full, or a folder that is gone, ends no flight.
TEST(Signature, WhatCannotBeKeptIsToldAndCommandsGoOn) {
  VERIFIES("LASSO-LNK-047~2");
  const std::filesystem::path store = made_store("lasso_signature_store");
  Signer signer(kKey);
  SignatureCheck check(kKey, {}, keep_in(store));
  std::filesystem::create_directories(store / "authentication.partial" / "full");
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(decode(check, signer.sign(test::ping(1))), PacketFault::kNone);
  EXPECT_EQ(decode(check, signer.sign(test::ping(2))), PacketFault::kNone);
  const std::string told = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("authentication: cannot be written"), std::string::npos) << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_THROW(static_cast<void>(keep_in(store)), InputError) << "before a flight it is an error";
}

TEST(Signature, WithoutAStoreOrWithANewOneWhatWasSignedBeforeIsRefused) {
  VERIFIES("LASSO-LNK-047~2");
  Signer signer(kKey);
  const Stream before = signer.sign(test::ping(1));
  for (const std::string& store : {std::string(), made_store("lasso_signature_new").string()}) {
    SignatureCheck check(kKey, state_at_start(store, "udp://:1"), keep_in(store));
    EXPECT_EQ(decode(check, before), PacketFault::kNotAuthentic) << store;
    EXPECT_EQ(decode(check, signer.sign(test::ping(1))), PacketFault::kNone) << store;
  }
  SignatureCheck of_a_file(kKey, state_at_start("", "file://commands"));
  EXPECT_EQ(decode(of_a_file, before), PacketFault::kNone);
}

TEST(Signature, AComponentHasTheMaster) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_THROW(SignatureCheck(derive_command_key(kKey, 1)), InputError);
}

}  // namespace
}  // namespace lasso::mdat
