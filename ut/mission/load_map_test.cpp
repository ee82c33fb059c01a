#include "fsw/mission/load_map.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(LoadMap, SaysWhatIsMissing) {
  VERIFIES("LASSO-IMG-012~1");
  const auto map = std::make_unique<LoadMap>();
  map->begin(100);
  EXPECT_EQ(map->missing(0).count, 100U);
  for (std::uint32_t block = 10; block < 75; ++block) map->mark(block);
  map->mark(20);  // again
  EXPECT_EQ(map->loaded(), 65U);
  EXPECT_EQ(map->missing(0).first, 0U);
  EXPECT_EQ(map->missing(0).count, 10U);
  EXPECT_EQ(map->missing(10).first, 75U);
  EXPECT_EQ(map->missing(10).count, 25U);
  EXPECT_EQ(map->missing(100).count, 0U);
  EXPECT_FALSE(map->complete());
  for (std::uint32_t block = 0; block < 100; ++block) map->mark(block);
  EXPECT_TRUE(map->complete());
  EXPECT_EQ(map->missing(0).count, 0U);
  map->begin(3);
  EXPECT_EQ(map->blocks(), 3U);
  EXPECT_EQ(map->loaded(), 0U);
}

// Against a set, in an order drawn at random.
TEST(LoadMap, KnowsEveryBlockWhateverTheOrder) {
  VERIFIES("LASSO-IMG-012~1");
  constexpr std::uint32_t kBlocks = 3000;
  const auto map = std::make_unique<LoadMap>();
  map->begin(kBlocks);
  std::set<std::uint32_t> there;
  std::uint32_t seed = 77;
  for (int i = 0; i < 2500; ++i) {
    seed = seed * 1664525U + 1013904223U;
    map->mark((seed >> 8) % kBlocks);
    there.insert((seed >> 8) % kBlocks);
  }
  EXPECT_EQ(map->loaded(), there.size());
  std::uint32_t missing = 0;
  for (BlockRun run = map->missing(0); run.count > 0; run = map->missing(run.first + run.count)) {
    for (std::uint32_t block = run.first; block < run.first + run.count; ++block) EXPECT_EQ(there.count(block), 0U);
    if (run.first > 0) {
      EXPECT_EQ(there.count(run.first - 1), 1U);
    }
    missing += run.count;
  }
  EXPECT_EQ(missing + there.size(), kBlocks);
}

TEST(LoadMap, HoldsTheLargestImage) {
  VERIFIES("LASSO-IMG-012~1");
  const auto map = std::make_unique<LoadMap>();
  map->begin(kMaxLoadBlocks);
  map->mark(kMaxLoadBlocks - 1);
  EXPECT_EQ(map->missing(0).count, kMaxLoadBlocks - 1);
}

}  // namespace
}  // namespace lasso
