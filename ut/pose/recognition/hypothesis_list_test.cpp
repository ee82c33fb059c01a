#include "fsw/pose/recognition/hypothesis_list.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "fsw/pose/recognition/hypothesis_score.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

Pose turned(double angle) {
  Pose pose;
  pose.q = exp_so3(angle * Vec3(0.36, -0.48, 0.8));
  return pose;
}

TEST(HypothesisList, KeepsTheBestOfEachPlaceBestFirst) {
  VERIFIES("LASSO-MOD-117~2");
  HypothesisList list;
  list.add(turned(0.0), 0.5);
  list.add(turned(0.3), 0.2);
  list.add(turned(0.02), 0.4);  // 1 deg from the first
  list.add(turned(0.32), 0.3);
  list.add(turned(0.6), 0.1);
  list.keep_best();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].score, 0.1);
  EXPECT_EQ(list[1].score, 0.2);
  EXPECT_EQ(list[2].score, 0.4);
  EXPECT_EQ(list.best_score(0), kAnyScore);
  list[2].score = 0.05;
  EXPECT_EQ(list.best_score(2), 0.1);
  EXPECT_EQ(list.best_score(3), 0.05);
  list.clear();
  EXPECT_EQ(list.size(), 0u);
  list.keep_best();
  EXPECT_EQ(list.size(), 0u);
}

TEST(HypothesisList, KeepsNoMoreThanAreDrawn) {
  VERIFIES("LASSO-MOD-117~2");
  HypothesisList list;
  for (std::size_t i = 0; i < kShortList; ++i) list.add(turned(0.09 * static_cast<double>(i)), static_cast<double>(kShortList - i));
  list.keep_best();
  ASSERT_EQ(list.size(), kAligned);
  for (std::size_t i = 0; i < kAligned; ++i) EXPECT_EQ(list[i].score, static_cast<double>(i + 1));
}

}  // namespace
}  // namespace lasso
