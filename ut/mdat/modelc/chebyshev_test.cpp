#include "mdat/modelc/chebyshev.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cfg/capacities.hpp"
#include "mdat/modelc/random.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Chebyshev, MatchesBruteForce) {
  VERIFIES("LASSO-MDL-002~1");
  Random random(31);
  const std::array<std::uint32_t, 3> size = {23, 17, 31};
  for (const int count : {1, 2, 7, 40}) {
    ChebyshevMap map(size[0], size[1], size[2]);
    std::vector<std::array<int, 3>> occupied;
    for (int i = 0; i < count; ++i) {
      std::array<int, 3> p{};
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<int>(random.uniform() * size[axis]);
      occupied.push_back(p);
      map.occupy(static_cast<std::uint32_t>(p[0]), static_cast<std::uint32_t>(p[1]), static_cast<std::uint32_t>(p[2]));
    }
    map.propagate();
    for (int z = 0; z < 31; ++z) {
      for (int y = 0; y < 17; ++y) {
        for (int x = 0; x < 23; ++x) {
          int truth = 1000;
          for (const auto& p : occupied) truth = std::min(truth, std::max({std::abs(p[0] - x), std::abs(p[1] - y), std::abs(p[2] - z)}));
          ASSERT_EQ(map.distance(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)),
                    static_cast<std::uint32_t>(truth));
        }
      }
    }
  }
}

TEST(Chebyshev, SaturatesAtTheFlightLimit) {
  VERIFIES("LASSO-MDL-002~1");
  ChebyshevMap map(600, 1, 1);
  map.occupy(0, 0, 0);
  map.propagate();
  EXPECT_EQ(map.distance(249, 0, 0), 249u);
  EXPECT_EQ(map.distance(599, 0, 0), kMaxCellDistance);
}

}  // namespace
}  // namespace lasso::mdat
