#include "fsw/core/fixed_vector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(FixedVector, RefusesWhatDoesNotFitAndChangesNothing) {
  VERIFIES("LASSO-COR-006~1");
  FixedVector<int, 3> v;
  EXPECT_TRUE(v.empty());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(v.push_back(10 + i));
  EXPECT_TRUE(v.full());
  EXPECT_FALSE(v.push_back(99));
  EXPECT_EQ(v.size(), 3U);
  EXPECT_EQ(v.capacity(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(v[i], 10 + static_cast<int>(i));
}

TEST(FixedVector, BehavesAsAVectorAndKeepsItsPeak) {
  VERIFIES("LASSO-COR-006~1 LASSO-COR-007~2");
  test::Generator generator(21);
  FixedVector<std::uint64_t, 17> v;
  std::vector<std::uint64_t> model;
  std::size_t peak = 0;
  for (int step = 0; step < 5000; ++step) {
    const std::uint64_t value = generator.bits();
    if (value % 13 == 0) {
      v.clear();
      model.clear();
    }
    const bool fits = model.size() < 17;
    ASSERT_EQ(v.push_back(value), fits);
    if (fits) model.push_back(value);
    peak = std::max(peak, model.size());
    ASSERT_EQ(std::vector<std::uint64_t>(v.begin(), v.end()), model);
    ASSERT_EQ(v.peak(), peak);
    ASSERT_EQ(v.full(), model.size() == 17);
  }
  EXPECT_EQ(peak, 17U);  // the walk has been at the limit
}

TEST(FixedVector, PeakOutlivesClear) {
  VERIFIES("LASSO-COR-007~2");
  FixedVector<int, 8> v;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(v.push_back(i));
  v.clear();
  EXPECT_EQ(v.size(), 0U);
  EXPECT_EQ(v.peak(), 5U);
  ASSERT_TRUE(v.push_back(1));
  EXPECT_EQ(v.peak(), 5U);
}

TEST(FixedVector, SpanShowsTheHeldElements) {
  VERIFIES("LASSO-COR-006~1");
  FixedVector<int, 8> v;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(v.push_back(i * i));
  const FixedVector<int, 8>& constant = v;
  EXPECT_EQ(constant.span().size(), 4U);
  EXPECT_EQ(constant.span()[3], 9);
  v[3] = 5;
  EXPECT_EQ(constant[3], 5);
  EXPECT_EQ(constant.end() - constant.begin(), 4);
}

TEST(FixedVectorDeathTest, AnIndexPastTheHeldElementsIsAnInvariant) {
  VERIFIES("LASSO-COR-008~2");
  FixedVector<int, 4> v;
  ASSERT_TRUE(v.push_back(1));
  const FixedVector<int, 4>& constant = v;
  EXPECT_DEATH(v[1] = 0, "invariant failed: FixedVector index");
  EXPECT_DEATH(static_cast<void>(constant[1]), "invariant failed: FixedVector index");
  EXPECT_DEATH(v.shrink(2), "invariant failed: FixedVector shrink");
  v.shrink(1);
  EXPECT_EQ(v.size(), 1U);
  v.shrink(0);
  EXPECT_DEATH(static_cast<void>(v[0]), "invariant failed: FixedVector index");
}

}  // namespace
}  // namespace lasso
