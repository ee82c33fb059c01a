#include "mdat/mcap/format.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

// The check value of the CRC's catalogue, and of a chain.
TEST(McapFormat, ItsChecksumIsTheOneOfIeee8023) {
  VERIFIES("LASSO-REC-001~1");
  EXPECT_EQ(crc32_of("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32_of("6789", crc32_of("12345")), 0xCBF43926U);
}

// By hand from the specification: opcode 5, a length of 64 bits, channel, sequence, two times, data.
TEST(McapFormat, AMessageIsTheBytesThatTheSpecificationSays) {
  VERIFIES("LASSO-REC-001~1");
  std::string bytes;
  put_message({0x0102, 3, 4, 5, "ab"}, bytes);
  const std::string expected("\x05\x18\0\0\0\0\0\0\0\x02\x01\x03\0\0\0\x04\0\0\0\0\0\0\0\x05\0\0\0\0\0\0\0ab", 33);
  EXPECT_EQ(bytes, expected);
}

TEST(McapFormat, ContentsComeBack) {
  VERIFIES("LASSO-REC-001~1");
  std::string bytes;
  put_channel({7, 2, "/scan", "cdr", {{"a", "b"}, {"c", ""}}}, bytes);
  Channel channel;
  ASSERT_TRUE(get(std::string_view(bytes).substr(kRecordHead), channel));
  EXPECT_EQ(channel.id, 7);
  EXPECT_EQ(channel.schema, 2);
  EXPECT_EQ(channel.topic, "/scan");
  EXPECT_EQ(channel.metadata, (Text{{"a", "b"}, {"c", ""}}));
}

TEST(McapFormat, AnAttachmentWithAnyOtherByteIsRefused) {
  VERIFIES("LASSO-REC-006~1");
  std::string bytes;
  put_attachment({1, 2, "name", "text/plain", "the content"}, bytes);
  Attachment attachment;
  ASSERT_TRUE(get(std::string_view(bytes).substr(kRecordHead), attachment));
  EXPECT_EQ(attachment.data, "the content");
  for (std::size_t at = kRecordHead; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_FALSE(get(std::string_view(damaged).substr(kRecordHead), attachment)) << at;
  }
}

TEST(McapFormat, WhatIsShorterThanItSaysIsRefused) {
  VERIFIES("LASSO-REC-006~1");
  std::string bytes;
  put_schema({1, "a/msg/B", "ros2msg", "int32 x"}, bytes);
  const std::string content = bytes.substr(kRecordHead);
  Schema schema;
  EXPECT_TRUE(get(content, schema));
  for (std::size_t size = 0; size < content.size(); ++size) EXPECT_FALSE(get(std::string_view(content).substr(0, size), schema)) << size;
}

}  // namespace
}  // namespace lasso::mdat::mcap
