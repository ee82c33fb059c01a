#include "mdat/link/signature.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fsw/link/commands.hpp"
#include "mdat/common/errors.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso::mdat {
namespace {

using test::Stream;
using test::view;

const Key kKey(32, 0x0B);

// The authenticator that a packet is given to counts what it lets pass.
PacketFault decode(Authenticator& check, const Stream& packet, Command& command) { return decode_command(view(packet), command, &check); }
PacketFault decode(Authenticator& check, const Stream& packet) {
  Command command;
  return decode(check, packet, command);
}

std::string written(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "lasso_key.txt";
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

std::string refusal(const std::string& file) {
  try {
    static_cast<void>(load_key(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Signature, ASignedCommandIsTheCommand) {
  VERIFIES("LASSO-LNK-021~1");
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
  VERIFIES("LASSO-LNK-021~1");
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
  VERIFIES("LASSO-LNK-021~1");
  Signer signer(kKey), stranger(Key(32, 0x0C));
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
  VERIFIES("LASSO-LNK-021~1");
  Signer signer(kKey);
  const Stream good = signer.sign(test::set_hold(1, 5));
  for (std::size_t bit = 6 * 8; bit < (good.size() - 2) * 8; ++bit) {  // those of the primary header are other faults
    SignatureCheck check(kKey);
    Stream forged = good;
    forged[bit / 8] = static_cast<std::uint8_t>(forged[bit / 8] ^ (1U << (bit % 8)));
    test::repair_crc(forged);
    ASSERT_NE(decode(check, forged), PacketFault::kNone) << bit;
  }
  SignatureCheck check(kKey);
  EXPECT_EQ(decode(check, good), PacketFault::kNone);
}

TEST(Signature, ARecordedCommandIsRefused) {
  VERIFIES("LASSO-LNK-021~1");
  Signer signer(kKey);
  SignatureCheck check(kKey);
  const Stream first = signer.sign(test::ping(1)), second = signer.sign(test::ping(2));
  EXPECT_EQ(decode(check, second), PacketFault::kNone);
  EXPECT_EQ(decode(check, second), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, first), PacketFault::kNotAuthentic);
  EXPECT_EQ(decode(check, signer.sign(test::ping(2))), PacketFault::kNone) << "of a number of its own";
}

TEST(Signature, AKeyIsReadOrRefusedInWords) {
  VERIFIES("LASSO-LNK-021~1");
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += "0b";
  EXPECT_EQ(load_key(written(digits + "\n")), kKey);
  for (const std::string& bad : {std::string(), digits.substr(2), digits + "0b", digits.substr(1) + "g", digits.substr(3) + ":0b"}) {
    EXPECT_NE(refusal(written(bad)).find("64 hexadecimal digits are expected"), std::string::npos) << bad;
  }
  EXPECT_NE(refusal("none.key").find("none.key: no such file"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
