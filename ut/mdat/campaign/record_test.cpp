#include "mdat/campaign/record.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::kPlan;
using test::message_of;

std::string without_end(const std::string& line) { return line.substr(0, line.size() - 1); }

TEST(CampaignRecord, HasTheChecksumOfItsText) {
  VERIFIES("LASSO-GND-059~1");
  EXPECT_EQ(record_line(17, "ok,1,2.5,"), "37fc3065,17,ok,1,2.5,\n");  // by a bitwise CRC-32C in Python of "17,ok,1,2.5,"
  const auto record = parse_record("37fc3065,17,ok,1,2.5,");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->number, 17U);
  EXPECT_EQ(record->fields, "ok,1,2.5,");
}

TEST(CampaignRecord, IsRefusedWithAnyBitTurnedOrAnyByteGone) {
  VERIFIES("LASSO-GND-059~1");
  const std::string line = without_end(record_line(4294967295, "ok,25,0,0.0125,,1e-05"));
  ASSERT_TRUE(parse_record(line));
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string turned = line;
      turned[i] = static_cast<char>(static_cast<unsigned char>(turned[i]) ^ (1U << bit));
      EXPECT_FALSE(parse_record(turned)) << turned;
    }
    EXPECT_FALSE(parse_record(line.substr(0, i))) << i;
    EXPECT_FALSE(parse_record(line.substr(i + 1))) << i;
  }
  for (const char* other : {"", ",", "00000000,", "00000000,,", "00000000,1", "00000000,4294967296,ok", "00000000,-1,ok"})
    EXPECT_FALSE(parse_record(other)) << other;
}

TEST(CampaignRecord, AReasonIsOneCellOfOneLine) {
  VERIFIES("LASSO-GND-059~1");
  const std::string fields = failed_fields("no \"model\", at\nline 3");
  EXPECT_EQ(fields, "failed:no 'model'; at line 3");
  EXPECT_TRUE(is_failed(fields));
  EXPECT_FALSE(is_failed("ok,failed:1"));
  EXPECT_TRUE(parse_record(without_end(record_line(0, "ok,\n\t\r"))));
}

TEST(CampaignRecord, AChunkIsReadUpToItsLastWholeLine) {
  VERIFIES("LASSO-GND-090~1");
  const std::string whole = chunk_heading(kPlan) + record_line(0, "ok,1") + "rubbish\n" + record_line(3, "ok,2");
  const std::string torn = record_line(6, "ok,3");
  for (std::size_t size = 0; size < torn.size(); ++size) {
    const std::string text = whole + torn.substr(0, size);
    const ChunkText chunk = parse_chunk("a.part", text, kPlan);
    ASSERT_EQ(chunk.records.size(), 2U);
    EXPECT_EQ(chunk.records[1].number, 3U);
    EXPECT_EQ(chunk.records[1].line, 4U);
    ASSERT_EQ(chunk.damaged.size(), 1U);
    EXPECT_EQ(chunk.damaged[0].number, 3U);
    EXPECT_EQ(chunk.torn, torn.substr(0, size));
  }
  EXPECT_EQ(parse_chunk("a.done", whole + "x", kPlan).damaged.size(), 2U);  // it had been whole
}

TEST(CampaignRecord, AHeadingIsOfThisPlan) {
  VERIFIES("LASSO-GND-090~1");
  const std::string heading = chunk_heading(kPlan);
  for (std::size_t size = 0; size < heading.size(); ++size)  // killed as it was written
    EXPECT_EQ(parse_chunk("a.part", heading.substr(0, size), kPlan).torn.size(), size);
  const auto refused = [](const std::string& text) { return message_of<InputError>([&] { parse_chunk("a.part", text, kPlan); }); };
  const std::string other = refused(chunk_heading(std::string(64, 'b')) + record_line(0, "ok"));
  EXPECT_NE(other.find("a.part: is of another plan (bbbbbbbbbbbb..., this folder's is aaaaaaaaaaaa...)"), std::string::npos) << other;
  EXPECT_NE(refused("case,x\n1,2\n").find("a.part:1: is not the first line"), std::string::npos);
  EXPECT_NE(refused("notes").find("a.part:1: is not the first line"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
