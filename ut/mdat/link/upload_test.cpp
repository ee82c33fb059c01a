#include "mdat/link/upload.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class SilentLink final : public ByteLink {
 public:
  bool datagrams() const override { return true; }
  std::size_t read(Bytes) override { return 0; }
  std::size_t write(ConstBytes packets) override {
    sent.emplace_back(packets.begin(), packets.end());
    return packets.size();
  }
  std::vector<std::vector<std::uint8_t>> sent;
};

// What is said of an image of some blocks, with a command at a place, that is uploaded to the component `apid`.
std::string said_of_command_at(std::size_t place, std::uint16_t apid = kApid) {
  std::vector<std::uint8_t> image(2000, 0x18);
  const std::vector<std::uint8_t> ping = encode_command(command_row("ping"), {}, 3, apid);
  std::copy(ping.begin(), ping.end(), image.begin() + static_cast<std::ptrdiff_t>(place));
  UploadOptions options;
  options.answer_s = 0.01;
  options.apid = apid;
  SilentLink link;
  try {
    static_cast<void>(upload(link, "link", image, options));
  } catch (const InputError& error) {
    return error.what();
  } catch (const RunError&) {
    return "sent";
  }
  return "done";
}

TEST(Upload, RefusesAnImageOfWhichABlockHoldsACommand) {
  VERIFIES("LASSO-LNK-038~2");
  const std::size_t block = kMemoryBlockBytes;
  for (const std::size_t place : {std::size_t{0}, block - 13, block, 3 * block + 7}) {
    const std::string said = said_of_command_at(place);
    EXPECT_NE(said.find("holds a command (ping) at byte " + std::to_string(place) + ":"), std::string::npos) << said;
  }
  for (const std::size_t between : {block - 12, block - 1, 3 * block - 6}) EXPECT_EQ(said_of_command_at(between), "sent") << between;
  EXPECT_NE(said_of_command_at(700, 0x2A5).find("holds a command (ping) at byte 700:"), std::string::npos) << "of its component";
}

TEST(Upload, GoesToTheComponentThatItIsFor) {
  VERIFIES("LASSO-LNK-044~1");
  UploadOptions options;
  options.answer_s = 0.01;
  options.apid = 0x2A5;
  SilentLink link;
  EXPECT_THROW(static_cast<void>(upload(link, "link", std::vector<std::uint8_t>(2000, 0x18), options)), RunError) << "nobody answers";
  ASSERT_FALSE(link.sent.empty());
  for (const std::vector<std::uint8_t>& packet : link.sent) EXPECT_EQ(apid_of({packet.data(), packet.size()}), 0x2A5);
}

// What is said of it; empty: it would be sent.
std::string said_of_signature(const std::vector<std::uint8_t>& image, const std::optional<Key>& key) {
  try {
    check_signature("a.3dli", image, key);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Key kMaster{std::vector<std::uint8_t>(32, 1), 0};

TEST(Upload, ASignedImageIsSentAsItIs) {
  VERIFIES("LASSO-LNK-055~1");
  const std::vector<std::uint8_t> plain = {'3', 'D', 'L', 'I', 0, 0, 0, 9, 0, 0, 0, 16, 1, 2, 3, 4}, right = sign_image(plain, kMaster);
  EXPECT_EQ(image_to_send(right, std::nullopt), right) << "the link may be authenticated below the component";
  EXPECT_EQ(image_to_send(plain, std::nullopt), plain);
  EXPECT_EQ(image_to_send(right, kMaster), right);
  EXPECT_EQ(image_to_send(plain, kMaster), right);
  EXPECT_EQ(image_to_send(right, derive_command_key(kMaster, 7)), right);
}

TEST(Upload, WhatWouldBeRefusedForItsSignatureIsNotSent) {
  VERIFIES("LASSO-LNK-045~1");
  const Key& master = kMaster;
  const Key other{std::vector<std::uint8_t>(32, 2), 0}, derived = derive_command_key(master, 7);
  const std::vector<std::uint8_t> plain = {'3', 'D', 'L', 'I', 0, 0, 0, 9, 0, 0, 0, 16, 1, 2, 3, 4}, right = sign_image(plain, master);
  for (const auto& image : {plain, right}) EXPECT_EQ(said_of_signature(image, std::nullopt), "");
  for (const auto& image : {plain, right}) EXPECT_EQ(said_of_signature(image, master), "") << "signed on the way, or right";
  EXPECT_EQ(said_of_signature(right, derived), "") << "whose it is, only the component can say";
  EXPECT_EQ(said_of_signature(right, other).rfind("a.3dli: is signed with another key; mdat mission sign", 0), 0U);
  EXPECT_EQ(said_of_signature(plain, derived).rfind("a.3dli: is not signed, and key 7 signs commands alone; mdat", 0), 0U);
}

}  // namespace
}  // namespace lasso::mdat
