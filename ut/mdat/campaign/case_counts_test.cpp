#include "mdat/campaign/case_counts.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Five frames: two wrong ones, an invalid one whose level is small, and a wrong one at the end.
CaseResult flight() {
  CaseResult result;
  result.frames.resize(5);
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    FrameError& frame = result.frames[i];
    frame.t_s = 0.2 * static_cast<double>(i);
    frame.reported = frame.valid = true;
    frame.level = {0.004, 0.01};
    frame.registration.translation_m = Vec3(0, 0, 0.001);
    frame.registration.rotation_rad = 0.02;
  }
  result.frames[0].wrong = result.frames[1].wrong = result.frames[4].wrong = true;
  result.frames[2].valid = false;
  result.end_s = 1;
  return result;
}

TEST(CaseCounts, AreOfItsEpisodesAndItsValidPoses) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const CaseCounts counts = counts_of(flight());
  EXPECT_EQ(counts.alert.text(), "200+ 400");
  EXPECT_EQ(counts.position_m.poses(), 4U);
  EXPECT_EQ(counts.position_m.misleading(), 0U);
  EXPECT_EQ(counts.attitude_rad.misleading(), 4U);
}

TEST(CaseCounts, ComeBackFromTheirCellsAndAddUp) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const CaseCounts counts = counts_of(flight());
  const std::vector<std::string> cells = count_cells(counts);
  ASSERT_EQ(cells.size(), count_names().size());
  std::optional<CaseCounts> read = counts_of_cells({cells.begin(), cells.end()});
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, counts);
  read->add(counts);
  EXPECT_EQ(read->alert.statistics().episodes, 4U);
  EXPECT_EQ(read->position_m.poses(), 8U);
  for (const std::string& cell : cells) EXPECT_EQ(cell.find(','), std::string::npos) << "a record's cells are divided by commas";
}

TEST(CaseCounts, OfARecordThatIsNotTheirsAreNone) {
  VERIFIES("LASSO-GND-131~1");
  EXPECT_TRUE(counts_of_cells({"", "", ""}));
  EXPECT_FALSE(counts_of_cells({"", ""}));
  EXPECT_FALSE(counts_of_cells({"", "", "", ""}));
  EXPECT_FALSE(counts_of_cells({"200*", "", ""}));
  EXPECT_FALSE(counts_of_cells({"", "1", ""}));
}

}  // namespace
}  // namespace lasso::mdat
