#include "hal_sim/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

// A square of 1 m whose left half has nine times as many points as its right half.
std::vector<Vec3> uneven_square() {
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 600; ++k) points.emplace_back(0.5 * i / 300, k / 600.0, 4);
  }
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 200; ++k) points.emplace_back(0.5 + 0.5 * i / 100, k / 200.0, 4);
  }
  return points;
}

TEST(Thinning, KeepsAsManyAsAskedForEachOnce) {
  VERIFIES("LASSO-SIM-040~1");
  const std::vector<Vec3> points = uneven_square();
  const std::vector<std::uint32_t> kept = thinned(points, 4096);
  EXPECT_EQ(kept.size(), 4096u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::set<std::uint32_t>(kept.begin(), kept.end()).size(), kept.size());
  EXPECT_LT(kept.back(), points.size());
  EXPECT_EQ(thinned(points, points.size()).size(), points.size()) << "nothing to leave out";
}

TEST(Thinning, SpreadsWhatIsKeptOverTheSurface) {
  VERIFIES("LASSO-SIM-040~1");
  const std::vector<Vec3> points = uneven_square();
  const std::vector<std::uint32_t> kept = thinned(points, 4096);
  std::size_t cells[8][8] = {};
  for (const std::uint32_t i : kept)
    ++cells[std::min(7, static_cast<int>(8 * points[i].x()))][std::min(7, static_cast<int>(8 * points[i].y()))];
  for (const auto& column : cells) {
    for (const std::size_t count : column) {
      EXPECT_GT(count, 32u) << "half of an even share";
      EXPECT_LT(count, 128u) << "twice an even share";
    }
  }
}

TEST(Thinning, KeepsTheSameWhateverTheUnitOfLength) {
  VERIFIES("LASSO-SIM-040~1");
  const std::vector<Vec3> points = uneven_square();
  std::vector<Vec3> scaled;
  for (const Vec3& point : points) scaled.push_back(1024 * point);  // exact
  EXPECT_EQ(thinned(scaled, 4096), thinned(points, 4096));
}

TEST(Thinning, OfOnePlaceOnePointIsLeft) {
  VERIFIES("LASSO-SIM-040~1");
  EXPECT_EQ(thinned(std::vector<Vec3>(100, Vec3(1, 2, 3)), 10), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace lasso::sim
