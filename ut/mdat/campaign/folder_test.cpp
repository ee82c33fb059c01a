#include "mdat/campaign/folder.hpp"

#include <gtest/gtest.h>

#include "mdat/campaign/record.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint32_t kCases = 12;

// The record of a case: a figure, and counts where the campaign keeps them.
struct MadeCase {
  CaseCounts counts;
  std::string fields;
};

MadeCase made_case(std::uint32_t number) {
  test::Generator random(100 + number);
  MadeCase made;
  for (int i = 0; i < 20; ++i) {
    const double level = 0.001 * random.uniform(1, 9);
    made.counts.position_m.add(level, level * random.uniform(0, 1.1));
    made.counts.attitude_rad.add(level, level * random.uniform(0, 0.9));
  }
  for (std::uint64_t i = random.below(3); i > 0; --i)
    made.counts.alert.add(WrongEpisode{0, 0.2 * static_cast<double>(1 + random.below(4)), random.below(4) == 0});
  made.fields = "ok," + std::to_string(number % 3);
  return made;
}

std::string with_counts(const MadeCase& made) {
  std::string fields = made.fields;
  for (const std::string& cell : count_cells(made.counts)) fields += "," + cell;
  return fields;
}

CampaignFolder folder_of(const test::ChunkFolder& chunks, bool counted) {
  CampaignFolder folder;
  folder.path = chunks.path();
  folder.digest = test::kPlan;
  folder.plan.campaign = "rough";
  folder.plan.figures = {"wrong"};
  if (counted) folder.plan.counts = count_names();
  folder.plan.cases = kCases;
  folder.plan.version = "0.9";
  folder.input.source.campaigns["rough"].cases = kCases;
  std::ofstream cases(chunks.path() / "cases.csv");
  cases << "case,seed,truth.range_m\n";
  for (std::uint32_t number = 0; number < kCases; ++number) cases << number << ",7,3\n";
  return folder;
}

TEST(MergedCampaign, HasTheCountsOfItsCasesInAnyChunksAndOrder) {
  VERIFIES("LASSO-GND-132~1");
  CaseCounts all;
  for (std::uint32_t number = 0; number < kCases; ++number) all.add(made_case(number).counts);
  for (const std::uint32_t chunks : {1U, 3U, 5U}) {
    const test::ChunkFolder files;
    const CampaignFolder folder = folder_of(files, true);
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
      std::string text = chunk_heading(test::kPlan);
      for (std::uint32_t number = kCases; number-- > 0;)
        if (number % chunks == chunk) text += record_line(number, with_counts(made_case(number)));
      files.write(std::to_string(chunk + 1) + "of" + std::to_string(chunks) + ".done", text);
    }
    const ResultTable table = merged(folder, false);
    ASSERT_EQ(table.rows.size(), kCases);
    EXPECT_EQ(table.counts, all) << chunks << " chunks";
    EXPECT_EQ(table.rows[5].figures, std::vector<double>{2});
  }
}

TEST(MergedCampaign, CountsTheCasesThatAreInItsTable) {
  VERIFIES("LASSO-GND-132~1");
  const test::ChunkFolder files;
  const CampaignFolder folder = folder_of(files, true);
  files.write("1of1.part", chunk_heading(test::kPlan) + record_line(2, with_counts(made_case(2))) + record_line(4, "failed:refused") +
                               record_line(7, with_counts(made_case(7))));
  CaseCounts both = made_case(2).counts;
  both.add(made_case(7).counts);
  EXPECT_EQ(merged(folder, true).counts, both);
}

TEST(MergedCampaign, OfAnEarlierVersionHasNoCounts) {
  VERIFIES("LASSO-GND-132~1");
  const test::ChunkFolder files;
  const CampaignFolder folder = folder_of(files, false);
  std::string text = chunk_heading(test::kPlan);
  for (std::uint32_t number = 0; number < kCases; ++number) text += record_line(number, made_case(number).fields);
  files.write("1of1.done", text);
  const ResultTable table = merged(folder, false);
  EXPECT_EQ(table.rows.size(), kCases);
  EXPECT_FALSE(table.counts);
  EXPECT_NE(write_results(folder, table).find("the mdat that flew this campaign did not keep them"), std::string::npos);
}

TEST(MergedCampaign, RefusesARecordWhoseCountsAreNotWhole) {
  VERIFIES("LASSO-GND-132~1");
  const test::ChunkFolder files;
  const CampaignFolder folder = folder_of(files, true);
  files.write("1of1.part", chunk_heading(test::kPlan) + record_line(2, made_case(2).fields));
  const std::string message = test::message_of<InputError>([&] { static_cast<void>(merged(folder, true)); });
  EXPECT_NE(message.find(": case 2: its record does not end with its counts; use the mdat that flew it (0.9"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace lasso::mdat
