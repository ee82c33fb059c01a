#include "mdat/campaign/records.hpp"

#include <gtest/gtest.h>

#include "mdat/campaign/chunk_file.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::ChunkFolder;
using test::kPlan;
using test::message_of;

TEST(CampaignRecords, AreTheSameInAnyChunksAndOrder) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  const std::string heading = chunk_heading(kPlan);
  folder.write("2of2.part", heading + record_line(3, "ok,d") + record_line(1, "failed:x") + "torn");
  folder.write("1of1.done", heading + record_line(0, "ok,a") + record_line(3, "ok,d"));  // twice the same
  folder.write("1of1.damaged", "no chunk\n");
  const Records records(folder.path(), kPlan, 5);
  EXPECT_EQ(records.of(0), "ok,a");
  EXPECT_EQ(records.of(1), "failed:x");
  EXPECT_EQ(records.of(2), std::nullopt);
  EXPECT_EQ(records.of(3), "ok,d");
  EXPECT_EQ(records.done(), 3U);
  EXPECT_EQ(records.failed(), 1U);
  EXPECT_EQ(records.missing(), 2U);
  EXPECT_TRUE(records.damaged().empty());
}

TEST(CampaignRecords, OfAChunkAreReadFromFilesThatCanHaveThem) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  folder.write("2of3.done", "of another plan, and not read\n");
  folder.write("1of3-2.done", chunk_heading(kPlan) + record_line(3, "ok"));
  folder.write("2of2.done", chunk_heading(kPlan) + record_line(1, "ok"));
  const Records records(folder.path(), kPlan, 6, Chunk{1, 3});
  EXPECT_EQ(records.done(), 2U);
}

TEST(CampaignRecords, RefuseTwoResultsOfACase) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  folder.write("1of1.part", chunk_heading(kPlan) + record_line(1, "ok,1"));
  folder.write("2of2.done", chunk_heading(kPlan) + record_line(3, "ok,1") + record_line(1, "ok,2"));
  const auto read = [&] { const Records records(folder.path(), kPlan, 4); };
  std::string message = message_of<InputError>(read);
  EXPECT_NE(message.find("2of2.done:3: case 1 has another result here than in " + folder.chunk("1of1.part").string() + ":2"),
            std::string::npos)
      << message;
  folder.write("2of2.done", chunk_heading(kPlan) + record_line(1, "failed:crashed with signal 11"));
  message = message_of<InputError>(read);
  EXPECT_NE(message.find("retry DIR --failed"), std::string::npos) << message;
  EXPECT_EQ(retry_failed(folder.path(), kPlan), 1U);
  EXPECT_EQ(Records(folder.path(), kPlan, 4).of(1), "ok,1");
}

TEST(CampaignRecords, RefuseACaseThatThePlanDoesNotHave) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  folder.write("1of1.part", chunk_heading(kPlan) + record_line(4, "ok,1"));
  const std::string message = message_of<InputError>([&] { const Records records(folder.path(), kPlan, 4); });
  EXPECT_NE(message.find("1of1.part:2: case 4: the plan's last case is 3"), std::string::npos) << message;
}

TEST(CampaignRecords, TellWhatIsDamaged) {
  VERIFIES("LASSO-GND-062~1");
  const ChunkFolder folder;
  folder.write("1of2.done", chunk_heading(kPlan) + record_line(0, "ok") + "rubbish\n" + record_line(2, "failed:y"));
  const Records records(folder.path(), kPlan, 4);
  ASSERT_EQ(records.damaged().size(), 1U);
  EXPECT_EQ(records.damaged()[0], folder.chunk("1of2.done").string() + ":3");
  ASSERT_EQ(records.damaged_files().size(), 1U);
  const std::string text = status_text(folder.path(), records);
  EXPECT_NE(text.find("2 of 4 cases are done, 1 of them failed, 2 are missing\n"), std::string::npos) << text;
  EXPECT_NE(text.find("1of2.done:3: a damaged record"), std::string::npos) << text;
  EXPECT_EQ(text.find("at work"), std::string::npos) << text;
}

TEST(CampaignRecords, FailedOnesAreTakenOutAndKept) {
  VERIFIES("LASSO-GND-063~1");
  const ChunkFolder folder;
  const std::string bad = record_line(0, "failed:x"), good = record_line(2, "ok");
  folder.write("1of2.done", chunk_heading(kPlan) + bad + good + "rubbish\n");
  folder.write("2of2.part", chunk_heading(kPlan) + record_line(1, "failed:y"));
  EXPECT_EQ(retry_failed(folder.path(), kPlan), 2U);
  EXPECT_EQ(folder.read("1of2.done"), chunk_heading(kPlan) + good);
  EXPECT_EQ(folder.read("1of2.failed"), bad);
  EXPECT_EQ(folder.read("1of2.damaged"), "rubbish\n");
  EXPECT_EQ(Records(folder.path(), kPlan, 4).missing(), 3U);
  EXPECT_EQ(retry_failed(folder.path(), kPlan), 0U);
}

TEST(CampaignRecords, AreNotTakenFromARunner) {
  VERIFIES("LASSO-GND-063~1");
  const ChunkFolder folder;
  ChunkFile runner(folder.path(), "1of1", kPlan);
  runner.append(0, "failed:x");
  EXPECT_NE(status_text(folder.path(), Records(folder.path(), kPlan, 2)).find("1 runner is at work"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { retry_failed(folder.path(), kPlan); }).find("another process flies this chunk"),
            std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
