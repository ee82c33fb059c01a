#include "mdat/mcap/indexed_file.hpp"

#include <algorithm>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/mcap/mcap_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

using McapIndexedFile = McapFile;

// All messages, chunk by chunk, as topic and data.
std::vector<std::pair<std::string, std::string>> messages_of(const IndexedFile& file) {
  std::vector<std::pair<std::string, std::string>> messages;
  for (const ChunkPlace& chunk : file.chunks()) {
    std::string why;
    const std::string records = file.records_of(chunk, why);
    for_each_message(records,
                     [&](const Message& message) { messages.emplace_back(file.channels().at(message.channel).topic, message.data); });
  }
  return messages;
}

TEST_F(McapIndexedFile, HoldsWhatTheStreamHolds) {
  VERIFIES("LASSO-WEB-011~1");
  write_three_chunks();
  const IndexedFile file(file_);
  EXPECT_TRUE(file.damage().empty());
  EXPECT_EQ(file.chunks().size(), 3U);
  EXPECT_EQ(messages_of(file), told().messages);
  EXPECT_EQ(file.schemas().at(1).name, "a/msg/B");
  EXPECT_EQ(file.counts().at(file.channel_of("/two").value()), 6U);
  EXPECT_EQ(file.attachments().at(0).name, "notes.txt");
  EXPECT_TRUE(file.attachment("notes.txt").has_value());
  EXPECT_EQ(file.attachment("others.txt"), std::nullopt);
  EXPECT_EQ(file.metadata().at("chunk").at("number"), "1");
}

// Large messages lie in chunks of their own: who wants the others unpacks none of these.
TEST_F(McapIndexedFile, LargeMessagesAreNotUnpackedForSmallOnes) {
  VERIFIES("LASSO-WEB-011~1");
  {
    Writer writer(file_, "ros2", "test");
    const std::uint16_t schema = writer.add_schema("a/msg/B", "ros2msg", "int32 x");
    const std::uint16_t small = writer.add_channel("/small", schema, "cdr");
    const std::uint16_t large = writer.add_channel("/large", schema, "cdr", {}, Bulk::kLarge);
    for (std::uint64_t i = 0; i < 40; ++i) {
      writer.write(small, i, std::string(100, 's'));
      writer.write(large, i, std::string(kChunkBytes / 8, static_cast<char>('a' + i % 20)));
    }
    writer.close();
  }
  const IndexedFile file(file_);
  const std::uint16_t small = file.channel_of("/small").value(), large = file.channel_of("/large").value();
  std::size_t of_small = 0, of_large = 0;
  for (const ChunkPlace& chunk : file.chunks()) {
    EXPECT_NE(chunk.may_have(small), chunk.may_have(large));
    (chunk.may_have(small) ? of_small : of_large) += chunk.size;
  }
  EXPECT_EQ(messages_of(file).size(), 80U);
  EXPECT_TRUE(of_small > 0 && of_large > 0);
  EXPECT_EQ(told().messages.size(), 80U);  // the stream's reader finds all of them
}

// Cut anywhere: whole chunks, in order, and the damage is told. What the stream's reader reads is what is found here.
TEST_F(McapIndexedFile, ACutFileIsWalked) {
  VERIFIES("LASSO-WEB-015~1");
  write_three_chunks();
  const std::string whole = bytes();
  for (std::size_t size = 60; size < whole.size(); size += 7) {
    put(std::string_view(whole).substr(0, size));
    const IndexedFile file(file_);
    EXPECT_FALSE(file.damage().empty()) << size;
    EXPECT_EQ(messages_of(file), told().messages) << size;
  }
}

// Read while it is written, after each flush: what is new is added, and what is not whole yet is no damage.
TEST_F(McapIndexedFile, AFileThatIsWrittenGrows) {
  VERIFIES("LASSO-WEB-021~1");
  Writer writer(file_, "ros2", "test");
  const std::uint16_t schema = writer.add_schema("a/msg/B", "ros2msg", "int32 x");
  const std::uint16_t small = writer.add_channel("/small", schema, "cdr");
  const std::uint16_t large = writer.add_channel("/large", schema, "cdr", {}, Bulk::kLarge);
  IndexedFile file(file_, writer.flush());
  EXPECT_TRUE(file.chunks().empty());
  std::vector<std::pair<std::string, std::string>> written;
  for (std::uint64_t i = 0; i < 6; ++i) {
    writer.write(small, i, "small " + std::to_string(i));
    written.emplace_back("/small", "small " + std::to_string(i));
    if (i % 2 == 1) {
      writer.write(large, i, "large " + std::to_string(i));
      written.emplace_back("/large", "large " + std::to_string(i));
    }
    file.grow(writer.flush());
    EXPECT_EQ(messages_of(file), written) << i;
    EXPECT_TRUE(file.damage().empty());
  }
  EXPECT_EQ(file.channel_of("/large"), std::optional(large));
  const std::uint64_t whole = file.size();
  file.grow(0);
  EXPECT_EQ(file.size(), whole);
  writer.close();
  EXPECT_EQ(messages_of(IndexedFile(file_)), written);
}

// A byte that is damaged: no crash, no message that is another, nothing beyond the file is asked for.
TEST_F(McapIndexedFile, DamageChangesNoMessage) {
  VERIFIES("LASSO-WEB-015~1");
  write_three_chunks();
  const std::string whole = bytes();
  const auto right = told().messages;
  sim::Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = whole;
    damaged[kMagic.size() + random.bits() % (whole.size() - kMagic.size())] = static_cast<char>(random.bits());
    put(damaged);
    try {
      const IndexedFile file(file_);
      (void)file.attachment("notes.txt");
      for (const ChunkPlace& chunk : file.chunks()) {
        std::string why;
        const std::string records = file.records_of(chunk, why);
        for_each_message(records, [&](const Message& message) {
          const std::string data(message.data);
          EXPECT_TRUE(std::any_of(right.begin(), right.end(), [&](const auto& row) { return row.second == data; })) << trial;
        });
      }
    } catch (const InputError&) {  // the header itself
    }
  }
}

}  // namespace
}  // namespace lasso::mdat::mcap
