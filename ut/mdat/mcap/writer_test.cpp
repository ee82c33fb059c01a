#include "mdat/mcap/writer.hpp"

#include <cstring>

#include "mdat/common/errors.hpp"
#include "ut/mdat/mcap/mcap_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

using McapWriter = McapFile;

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// Readers that seek begin at the end: the footer says where the summary is, and its groups where each kind of record begins.
TEST_F(McapWriter, TheFooterLeadsToEachGroupOfTheSummary) {
  VERIFIES("LASSO-REC-001~1");
  write_three_chunks();
  const std::string whole = bytes();
  const std::size_t footer = whole.size() - kMagic.size() - kRecordHead - 20;
  ASSERT_EQ(whole[footer], static_cast<char>(Op::kFooter));
  const std::uint64_t summary = number_at(whole, footer + 9), offsets = number_at(whole, footer + 17);
  std::uint32_t crc = 0;
  std::memcpy(&crc, whole.data() + footer + 25, sizeof crc);
  EXPECT_EQ(crc, crc32_of(std::string_view(whole).substr(summary, footer + 25 - summary)));
  std::uint64_t at = summary;
  for (std::uint64_t record = offsets; record < footer; record += 26) {
    ASSERT_EQ(whole[record], static_cast<char>(Op::kSummaryOffset));
    EXPECT_EQ(number_at(whole, record + 10), at);                        // groups follow one another
    EXPECT_EQ(whole[number_at(whole, record + 10)], whole[record + 9]);  // of the kind that it says
    at += number_at(whole, record + 18);
  }
  EXPECT_EQ(at, offsets);
}

// Each chunk index leads to a chunk, and each of its message indexes to one of that channel.
TEST_F(McapWriter, TheIndexLeadsToEachChunk) {
  VERIFIES("LASSO-REC-001~1");
  write_three_chunks();
  const std::string whole = bytes();
  const std::uint64_t summary = number_at(whole, whole.size() - kMagic.size() - 20);
  int chunks = 0;
  for (std::uint64_t at = summary; whole[at] != static_cast<char>(Op::kFooter); at += kRecordHead + number_at(whole, at + 1)) {
    if (whole[at] != static_cast<char>(Op::kChunkIndex)) continue;
    const std::uint64_t place = number_at(whole, at + 25), length = number_at(whole, at + 33);
    EXPECT_EQ(whole[place], static_cast<char>(Op::kChunk));
    EXPECT_EQ(number_at(whole, place + 1) + kRecordHead, length);
    EXPECT_EQ(number_at(whole, at + 9), static_cast<std::uint64_t>(4 * chunks));  // its first time
    EXPECT_EQ(whole[place + length], static_cast<char>(Op::kMessageIndex));
    ++chunks;
  }
  EXPECT_EQ(chunks, 3);
}

TEST_F(McapWriter, AFileThatCannotBeWrittenIsNamed) {
  VERIFIES("LASSO-REC-008~2");
  try {
    Writer writer("/nowhere/run.mcap", "ros2", "test");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/run.mcap: cannot be written"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lasso::mdat::mcap
