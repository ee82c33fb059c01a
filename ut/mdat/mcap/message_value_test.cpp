#include "mdat/mcap/message_value.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mdat/mcap/cdr.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

const Definition& mixed() {
  static const Definition kMixed = parse_definition(
      "a/msg/Mixed",
      "uint8 small\nfloat64 real\nEmpty nothing\nInner[] inner\nuint8[] data\nint16[3] three\nbool yes\nstring text\nuint64 big\n"
      "===\nMSG: a/Empty\n===\nMSG: a/Inner\nfloat32 x\nstring name\n");
  return kMixed;
}

// Written by hand, field by field.
std::string mixed_message() {
  CdrWriter out;
  out.put(std::uint8_t{7}).put(-2.5).put(std::uint8_t{0}).put(std::uint32_t{2});
  out.put(1.5F).text("one").put(0.1F).text("");
  out.blob("abc").put(std::int16_t{-1}).put(std::int16_t{0}).put(std::int16_t{300}).put(std::uint8_t{1}).text("end").put(~std::uint64_t{0});
  return out.bytes();
}

TEST(MessageValue, IsWhatStandsInTheMessage) {
  VERIFIES("LASSO-REC-009~1");
  const MessageValue value = value_of(mixed(), mixed_message());
  EXPECT_EQ(value.at("small"), 7);
  EXPECT_EQ(value.at("real"), -2.5);
  EXPECT_EQ(value.at("inner").size(), 2U);
  EXPECT_EQ(value.at("inner")[1].at("x"), static_cast<double>(0.1F));
  EXPECT_EQ(value.at("data").get_binary().size(), 3U);
  EXPECT_EQ(value.at("three"), MessageValue::array({-1, 0, 300}));
  EXPECT_EQ(value.at("yes"), true);
  EXPECT_EQ(value.at("text"), "end");
  EXPECT_EQ(value.at("big").get<std::uint64_t>(), ~std::uint64_t{0});
}

TEST(MessageValue, ComesBackByteByByte) {
  VERIFIES("LASSO-REC-009~1");
  EXPECT_EQ(message_of(mixed(), value_of(mixed(), mixed_message())), mixed_message());
}

TEST(MessageValue, AMessageOfAnotherLengthIsRefused) {
  VERIFIES("LASSO-REC-008~2");
  const std::string message = mixed_message();
  for (std::size_t size = 0; size < message.size(); ++size)
    EXPECT_THROW((void)value_of(mixed(), message.substr(0, size)), std::invalid_argument) << size;
  EXPECT_NO_THROW((void)value_of(mixed(), message + std::string(3, '\0')));  // padding
  EXPECT_THROW((void)value_of(mixed(), message + std::string(8, '\0')), std::invalid_argument);
}

// A damaged count asks for no memory beyond the message.
TEST(MessageValue, ACountBeyondTheMessageIsRefused) {
  VERIFIES("LASSO-REC-008~2");
  const Definition list = parse_definition("a/msg/List", "E[] many\n===\nMSG: a/E\nint32 x\n");
  CdrWriter out;
  out.put(std::uint32_t{0xFFFFFFFF});
  EXPECT_THROW((void)value_of(list, out.bytes()), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::mdat::mcap
