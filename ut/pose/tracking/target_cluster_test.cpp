#include "fsw/pose/tracking/target_cluster.hpp"

#include <memory>

#include "fsw/geometry/types.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class LoneGroup : public ::testing::Test {
 protected:
  void add(const Vec3& p, std::int32_t tag = 0) {
    ASSERT_TRUE(returns_->push_back({{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())}, tag, false}));
  }
  // n returns on a ball of the radius, tagged.
  void add_ball(const Vec3& center, double radius, int n, std::int32_t tag) {
    for (int i = 0; i < n; ++i) {
      Vec3 v;
      for (int k = 0; k < 3; ++k) v[k] = random_.normal();
      add(center + radius * v.normalized(), tag);
    }
  }
  // Returns of a wall across the boresight, `side` each way, `step` apart.
  void add_wall(double z, int side, double step, std::int32_t tag) {
    for (int i = 0; i < side * side; ++i) add(Vec3(step * (i % side - 0.5 * side), step * (i / side - 0.5 * side), z), tag);
  }
  int tagged(std::int32_t tag) const {
    int count = 0;
    for (const FieldReturn& r : *returns_) count += r.after_us == tag ? 1 : 0;
    return count;
  }
  test::Generator random_{7};
  std::unique_ptr<FieldReturns> returns_ = std::make_unique<FieldReturns>();
};

TEST_F(LoneGroup, AllOfATargetAloneStaysInItsOrder) {
  VERIFIES("LASSO-MOD-102~2");
  for (int i = 0; i < 60; ++i) add_ball(Vec3(0.3, -0.2, 9), 0.8, 1, i);
  EXPECT_TRUE(keep_target_cluster(1.2, *returns_));
  ASSERT_EQ(returns_->size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ((*returns_)[i].after_us, static_cast<std::int32_t>(i));
}

TEST_F(LoneGroup, BackgroundWithTenTimesTheReturnsGoes) {
  VERIFIES("LASSO-MOD-102~2");
  add_wall(30, 25, 0.5, 1);
  add_ball(Vec3(0.5, 0.4, 20), 0.8, 60, 2);
  add_wall(12, 3, 9, 3);  // specks far apart before it
  EXPECT_TRUE(keep_target_cluster(1.2, *returns_));
  EXPECT_EQ(returns_->size(), 60u);
  EXPECT_EQ(tagged(2), 60);
}

TEST_F(LoneGroup, AWallAloneIsNoTarget) {
  VERIFIES("LASSO-MOD-102~2");
  add_wall(30, 40, 0.5, 1);
  EXPECT_FALSE(keep_target_cluster(1.2, *returns_));
  EXPECT_EQ(returns_->size(), 1600u);  // as it was
}

TEST_F(LoneGroup, StraysNearTheTargetGo) {
  VERIFIES("LASSO-MOD-102~2");
  add_ball(Vec3(0, 0, 20), 1.0, 80, 1);
  for (int i = 0; i < 200; ++i) {
    Vec3 p(0, 0, random_.uniform(1, 30));
    for (int k = 0; k < 2; ++k) p[k] = random_.uniform(-5, 5);
    add(p, 2);
  }
  add(Vec3(0, 0, 22.2), 3);  // inside of the reach, with no neighbour
  EXPECT_TRUE(keep_target_cluster(1.2, *returns_));
  EXPECT_EQ(tagged(3), 0);
  EXPECT_LE(tagged(2), 2);
  EXPECT_GE(tagged(1), 72);
}

// By hand: of up to 32 others one must be near, of up to 64 two.
TEST_F(LoneGroup, AThirtySecondOfTheGroupMakesANeighbourhood) {
  VERIFIES("LASSO-MOD-102~2");
  const auto apart = [this](int together, int others) {
    returns_->clear();
    for (int i = 0; i < together; ++i) add(Vec3(0, 0, 10), 1);
    for (int i = 0; i < others; ++i) add(Vec3(0, 1.5, 10), 2);
    EXPECT_TRUE(keep_target_cluster(1.0, *returns_));
    EXPECT_EQ(tagged(1), together);
    return tagged(2);
  };
  EXPECT_EQ(apart(30, 1), 0);
  EXPECT_EQ(apart(30, 2), 2);
  EXPECT_EQ(apart(31, 2), 2);  // 32 others
  EXPECT_EQ(apart(32, 2), 0);  // 33 others
  EXPECT_EQ(apart(32, 3), 3);
}

TEST_F(LoneGroup, MoreReturnsThanAreTriedAreStillSorted) {
  VERIFIES("LASSO-MOD-102~2");
  add_wall(60, 55, 1.0, 1);
  add_ball(Vec3(3, -2, 40), 1.6, 400, 2);
  EXPECT_TRUE(keep_target_cluster(2.4, *returns_));
  EXPECT_EQ(tagged(1), 0);
  EXPECT_EQ(tagged(2), 400);
}

TEST_F(LoneGroup, NothingIsNoGroup) {
  VERIFIES("LASSO-MOD-102~2");
  EXPECT_FALSE(keep_target_cluster(1.2, *returns_));
}

}  // namespace
}  // namespace lasso
