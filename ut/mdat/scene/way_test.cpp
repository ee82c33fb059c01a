#include "mdat/scene/way.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

MotionTable two_ways() {
  MotionTable table;
  table.times_s = {1, 11, 31};
  table.positions_m = {Vec3(0.1, 0.2, 60), Vec3(4.1, -1.8, 20), Vec3(4.1, 0.2, 30)};
  return table;
}

TEST(Way, IsAtItsPlacesAtTheirTimesAndRestsThere) {
  VERIFIES("LASSO-SCN-006~2 LASSO-SIM-035~1");
  const MotionTable table = two_ways();
  const Way way(table);
  for (std::size_t i = 0; i < 3; ++i) {
    const MotionState state = way.at(std::llround(1e6 * table.times_s[i]));
    EXPECT_NEAR((state.T_a_b.p - table.positions_m[i]).norm(), 0, 1e-12);
    EXPECT_NEAR(state.rates.v_mps.norm(), 0, 1e-12);
  }
  EXPECT_EQ(way.at(-500000).T_a_b.p, table.positions_m.front());
  EXPECT_EQ(way.at(900000000).T_a_b.p, table.positions_m.back());
  const MotionState middle = way.at(6000000);  // half as fast again as on average
  EXPECT_NEAR((middle.T_a_b.p - Vec3(2.1, -0.8, 40)).norm(), 0, 1e-12);
  EXPECT_NEAR((middle.rates.v_mps - 1.5 * Vec3(0.4, -0.2, -4)).norm(), 0, 1e-12);
}

// A cubic is its Hermite polynomial: the table that interpolates any of them finds the same.
TEST(Way, IsTheTableAtRestInItsRows) {
  VERIFIES("LASSO-SCN-006~2");
  test::Generator random(5);
  MotionTable table = two_ways();
  const Way way(table);
  table.velocities_mps.assign(3, Vec3::Zero());
  const TableMotion hermite(table);
  for (int i = 0; i < 100; ++i) {
    const TimeUs t_us = random_time_us(random, -3, 40);
    ASSERT_LT((way.at(t_us).T_a_b.p - hermite.at(t_us).T_a_b.p).norm(), 1e-12);
    ASSERT_LT(rate_error(way.at(t_us).rates, hermite.at(t_us).rates), 1e-12);
    ASSERT_LT(rate_error(way, t_us), 1e-9);
  }
}

TEST(Way, RefusesWhatHasNoMeaning) {
  VERIFIES("LASSO-SCN-003~1");
  const auto said = [](const std::function<void(MotionTable&)>& change) {
    MotionTable table = two_ways();
    change(table);
    return problems_of([&] { static_cast<void>(Way(table)); });
  };
  EXPECT_EQ(said([](MotionTable&) {}), "");
  EXPECT_NE(said([](MotionTable& t) { t.times_s[1] = 1; }).find("is not after"), std::string::npos);
  EXPECT_NE(said([](MotionTable& t) { t.positions_m.pop_back(); }).find("different lengths"), std::string::npos);
  EXPECT_NE(said([](MotionTable& t) { t.positions_m.clear(); }).find("has no positions"), std::string::npos);
  EXPECT_NE(said([](MotionTable& t) { t.positions_m[2].y() = kNan; }).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat::scene
