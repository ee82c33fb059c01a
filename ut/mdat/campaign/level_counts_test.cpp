#include "mdat/campaign/level_counts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct LevelAndError {
  double level, error;
};

// Levels over four decades, errors from far below to somewhat above them.
LevelAndError random_pose(test::Generator& random) {
  const double level = std::pow(10, random.uniform(-5, -1));
  return {level, level * std::pow(10, random.uniform(-1.7, 0.3))};
}

TEST(LevelCounts, CountMisleadingPosesExactly) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(21);
  LevelCounts counts;
  std::size_t misleading = 0;
  for (int i = 0; i < 3000; ++i) {
    LevelAndError pose = random_pose(random);
    if (i % 3 == 0) pose.error = pose.level;                                          // within, just
    if (i % 3 == 1) pose.error = std::nextafter(pose.level, i % 2 == 0 ? 1.0 : 0.0);  // misleading, just, or not
    misleading += pose.error > pose.level ? 1U : 0U;
    counts.add(pose.level, pose.error);
  }
  EXPECT_EQ(counts.poses(), 3000U);
  EXPECT_EQ(counts.misleading(), misleading);
  EXPECT_GT(misleading, 500U);
}

TEST(LevelCounts, KnowTheMedianToWithinHalfACell) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(22);
  for (int round = 0; round < 50; ++round) {
    LevelCounts counts;
    std::vector<double> levels;
    for (int i = 0; i < 1 + 7 * round; ++i) {
      const LevelAndError pose = random_pose(random);
      levels.push_back(pose.level);
      counts.add(pose.level, pose.error);
    }
    std::sort(levels.begin(), levels.end());
    EXPECT_NEAR(counts.median() / levels[(levels.size() - 1) / 2], 1, 0.045);
  }
  EXPECT_TRUE(std::isnan(LevelCounts().median()));
}

TEST(LevelCounts, PutEachPoseIntoTheCellAroundIt) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(23);
  for (int i = 0; i < 500; ++i) {
    const LevelAndError pose = random_pose(random);
    LevelCounts counts;
    counts.add(pose.level, pose.error);
    const LevelCounts::Cell cell = counts.cells().at(0);
    EXPECT_NEAR(std::log2(cell.level / pose.level), 0, 1.0 / 16 + 1e-12);
    EXPECT_NEAR(std::log2(cell.error / cell.level) - std::log2(pose.error / pose.level), 0, 1.0 / 8 + 1e-12);
    EXPECT_EQ(cell.misleading, pose.error > pose.level);
    EXPECT_EQ(cell.error > cell.level, cell.misleading) << "its middle is on the same side";
  }
}

TEST(LevelCounts, AreTheSameWhateverPartsTheyComeFrom) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(24);
  LevelCounts whole, backwards;
  std::vector<LevelCounts> parts(5);
  for (std::size_t i = 0; i < 2000; ++i) {
    const LevelAndError pose = random_pose(random);
    whole.add(pose.level, pose.error);
    parts[i % parts.size()].add(pose.level, pose.error);
  }
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const std::optional<LevelCounts> read = LevelCounts::of(part->text());
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, *part);
    backwards.add(*read);
  }
  EXPECT_EQ(backwards, whole);
  EXPECT_EQ(backwards.text(), whole.text());
}

TEST(LevelCounts, AreShortText) {
  VERIFIES("LASSO-GND-131~1");
  LevelCounts counts;
  counts.add(1, 0.9);
  counts.add(1, 0.9);
  counts.add(1, 2);
  counts.add(0.9, 0.1);
  EXPECT_EQ(counts.text(), "-2:-13 0:-1*2/4");
  for (const char* text : {"x", "1", "1:", "1:2 ", "1:2*", "1:2,3:4", "1:2 1:3", "2:1 1:1", "/1", "1:1*0", " 1:2"})
    EXPECT_FALSE(LevelCounts::of(text)) << text;
  EXPECT_EQ(LevelCounts::of(""), LevelCounts());
}

// No covariance, or one that is not finite, promises all or nothing: the pose is counted at an end.
TEST(LevelCounts, HaveAPlaceForWhateverALevelIs) {
  VERIFIES("LASSO-GND-131~1");
  LevelCounts counts;
  const double infinite = std::numeric_limits<double>::infinity();
  counts.add(0, 1e-3);
  counts.add(0, 0);
  counts.add(infinite, 1);
  counts.add(1e-30, 1e30);
  EXPECT_EQ(counts.poses(), 4U);
  EXPECT_EQ(counts.misleading(), 2U);
  for (const LevelCounts::Cell& cell : counts.cells()) EXPECT_TRUE(std::isfinite(cell.level) && std::isfinite(cell.error));
}

}  // namespace
}  // namespace lasso::mdat
